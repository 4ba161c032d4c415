import { describe, expect, it } from "vitest";
import { fileNameOf } from "./file_name";

describe("the name of a file", () => {
  it("is the one that the service gives it", () => {
    expect(fileNameOf('attachment; filename="VIN-1-pdf.pdf"')).toBe("VIN-1-pdf.pdf");
  });

  it("is the one with all letters where there is one", () => {
    const said = "attachment; filename=\"VIN__-csv.csv\"; filename*=UTF-8''VIN_%C3%84-csv.csv";
    expect(fileNameOf(said)).toBe("VIN_Ä-csv.csv");
  });

  it("may be missing", () => {
    expect(fileNameOf("inline")).toBeUndefined();
  });
});
