import { describe, expect, it } from "vitest";
import { Pace } from "./pace";

describe("the pace of pictures", () => {
  it("is that of the last two seconds", () => {
    const pace = new Pace();
    expect(pace.rate).toBeNull();
    for (let at = 0; at <= 5000; at += 500) pace.judge(at, at);
    for (let at = 5100; at <= 8000; at += 100) pace.judge(at, at);
    expect(pace.rate).toBeCloseTo(10);
  });

  it("has a round trip only for frames that were sent from here", () => {
    const pace = new Pace();
    pace.judge(1, 10);
    expect(pace.roundTrip).toBeNull();
    pace.send(2, 20);
    pace.send(3, 25);
    pace.judge(3, 65);
    expect(pace.roundTrip).toBe(40);
    pace.judge(2, 99);
    expect(pace.roundTrip).toBe(40);
  });

  it("forgets all of it with the connection", () => {
    const pace = new Pace();
    pace.send(1, 0);
    pace.judge(1, 5);
    pace.judge(2, 10);
    pace.forget();
    expect([pace.rate, pace.roundTrip]).toEqual([null, null]);
  });
});
