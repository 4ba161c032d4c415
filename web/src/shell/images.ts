// Camera images for the page on show: fetched once each, with the key, as object URLs.
import { useEffect, useState } from "preact/hooks";
import { getImage } from "../api/client";
import { recoveries } from "../api/connection";
import { RequestFailed } from "../api/problem";

const held = new Map<string, Promise<string>>();

function objectUrlOf(url: string): Promise<string> {
  const known = held.get(url);
  if (known !== undefined) return known;
  const made = getImage(url).then((blob) => URL.createObjectURL(blob));
  held.set(url, made);
  made.catch(() => held.delete(url));
  return made;
}

/** Gives the memory of all images back; for when the page that shows them goes. */
export function releaseImages(): void {
  for (const made of held.values()) {
    made.then(
      (objectUrl) => URL.revokeObjectURL(objectUrl),
      () => undefined,
    );
  }
  held.clear();
}

export type ImageState = { state: "loading" } | { state: "ready"; objectUrl: string } | { state: "failed" };

export function useImage(url: string): ImageState {
  const [loaded, setLoaded] = useState<{ url: string; image: ImageState } | null>(null);
  const recovered = recoveries.value;

  useEffect(() => {
    let wanted = true;
    const show = (image: ImageState): void => {
      if (wanted) setLoaded({ url, image });
    };
    objectUrlOf(url).then(
      (objectUrl) => show({ state: "ready", objectUrl }),
      (error: unknown) => {
        if (!(error instanceof RequestFailed)) throw error;
        show({ state: "failed" });
      },
    );
    return () => {
      wanted = false;
    };
  }, [url, recovered]);

  return loaded?.url === url ? loaded.image : { state: "loading" };
}

/** The image as something a canvas can draw; null until it is decoded. */
export function useDrawable(image: ImageState): HTMLImageElement | null {
  const [drawable, setDrawable] = useState<HTMLImageElement | null>(null);
  const objectUrl = image.state === "ready" ? image.objectUrl : null;

  useEffect(() => {
    setDrawable(null);
    if (objectUrl === null) return undefined;
    let wanted = true;
    const element = new Image();
    element.onload = () => {
      if (wanted) setDrawable(element);
    };
    element.src = objectUrl;
    return () => {
      wanted = false;
    };
  }, [objectUrl]);

  return drawable;
}
