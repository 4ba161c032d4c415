import { describe, expect, it } from "vitest";
import { meansUnreachable, mustAskForKey, problemFrom, UNREACHABLE } from "./problem";

describe("a problem out of an answer", () => {
  it("takes title, detail, code and trace from a problem document", () => {
    const problem = problemFrom(409, {
      type: "/problems/run-already-finished",
      title: "The run is finished",
      detail: "Open a new run.",
      status: 409,
      code: "run-already-finished",
      trace_id: "abc",
    });
    expect(problem).toEqual({
      status: 409,
      code: "run-already-finished",
      title: "The run is finished",
      detail: "Open a new run.",
      errors: [],
      traceId: "abc",
    });
  });

  it("keeps the pointers of validation errors and drops what is none", () => {
    const { errors } = problemFrom(422, {
      errors: [{ pointer: "/serial", detail: "too long" }, "nonsense", null],
    });
    expect(errors).toEqual([{ pointer: "/serial", detail: "too long" }]);
  });

  it.each([null, "Bad gateway", [1], 7])("says something even when the body is %j", (body) => {
    const problem = problemFrom(502, body);
    expect(problem.title).toBe("HTTP 502");
    expect(problem.code).toBe("http-502");
    expect(problem.traceId).toBeNull();
  });
});

describe("what a problem means", () => {
  it("takes a silent service and a gateway without one for no server", () => {
    expect(meansUnreachable(UNREACHABLE)).toBe(true);
    expect(meansUnreachable(problemFrom(503, null))).toBe(true);
    expect(meansUnreachable(problemFrom(500, null))).toBe(false);
  });

  it("asks for a key only when the service knows nobody, not when the role is too low", () => {
    expect(mustAskForKey(problemFrom(401, null))).toBe(true);
    expect(mustAskForKey(problemFrom(403, null))).toBe(false);
  });
});
