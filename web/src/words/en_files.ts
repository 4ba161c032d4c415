// Every text in English about the files of a result.
export const enFiles = {
  files_title: "Certificate and exports",
  files_certificate: "Certificate (.jws)",
  files_certificate_detail: "Signed when the run was finished. “dmscal verify” checks it anywhere.",
  files_certificate_of_fail:
    "Signed when the run was finished. It says FAIL. “dmscal verify” checks it anywhere.",
  files_allow_failed: "This camera failed: export its values anyway, marked FAIL",
  files_formats: "Formats",
  files_pdf: "PDF report",
  files_block: "Binary block",
};
