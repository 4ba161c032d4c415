// Every text in German about the files of a result.
export const deFiles = {
  files_title: "Zertifikat und Exporte",
  files_certificate: "Zertifikat (.jws)",
  files_certificate_detail: "Signiert, als der Lauf abgeschlossen wurde. „dmscal verify“ prüft es überall.",
  files_certificate_of_fail:
    "Signiert, als der Lauf abgeschlossen wurde. Es sagt FAIL. „dmscal verify“ prüft es überall.",
  files_allow_failed: "Diese Kamera hat nicht bestanden: Werte trotzdem exportieren, als FAIL markiert",
  files_formats: "Formate",
  files_pdf: "PDF-Bericht",
  files_block: "Binärblock",
};
