import { describe, expect, it } from "vitest";
import { KEY_REFUSED, NO_STATION, retryAfter, ROLE_REFUSED, socketAddress, STATION_TAKEN } from "./socket";

describe("a lost socket", () => {
  it("is tried again soon, then less often, but never later than three seconds", () => {
    const waits = [0, 1, 2, 3, 9].map((attempt) => retryAfter(1006, attempt));

    expect(waits).toEqual([400, 800, 1600, 3000, 3000]);
  });

  it("is not tried again where the same hello gets the same answer", () => {
    for (const code of [KEY_REFUSED, ROLE_REFUSED, NO_STATION]) expect(retryAfter(code, 0)).toBeNull();
  });

  it("is tried again while another kiosk has the station: that one may go", () => {
    expect(retryAfter(STATION_TAKEN, 0)).toBe(3000);
  });
});

it("a socket's address keeps the page's scheme and escapes the station's code", () => {
  expect(socketAddress("https://plant:8443", "line 1/a")).toBe(
    "wss://plant:8443/ws/v1/stations/line%201%2Fa/guidance",
  );
});
