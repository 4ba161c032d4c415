// Every text in Chinese about the files of a result.
export const zhFiles = {
  files_title: "证书与导出",
  files_certificate: "证书 (.jws)",
  files_certificate_detail: "在运行完成时签名，可在任何地方用“dmscal verify”核验。",
  files_certificate_of_fail: "在运行完成时签名，其结论为 FAIL，可在任何地方用“dmscal verify”核验。",
  files_allow_failed: "此相机不合格：仍然导出其数值，并标记为 FAIL",
  files_formats: "格式",
  files_pdf: "PDF 报告",
  files_block: "二进制数据块",
};
