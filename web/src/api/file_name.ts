// The name that an answer gives its file (RFC 6266).

/** The name in a Content-Disposition, the one with all letters where there is one; undefined without a name. */
export function fileNameOf(disposition: string): string | undefined {
  const encoded = /filename\*=UTF-8''([^;]+)/.exec(disposition)?.[1];
  return encoded === undefined ? /filename="([^"]+)"/.exec(disposition)?.[1] : decodeURIComponent(encoded);
}
