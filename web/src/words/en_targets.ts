// Every text in English about targets: their list, their sheets to print, and showing one on a screen.
export const enTargets = {
  nav_targets: "Targets",
  targets_title: "Targets",
  targets_none: "No board is registered yet",
  targets_none_detail:
    "An engineer registers the boards of the plant with POST /api/v1/targets. Any target can be printed or shown without that: name it above.",
  targets_name: "Print or show a target",
  targets_name_hint: "such as chessboard:9x6:25mm",
  targets_open: "Open",
  targets_registered: "Registered boards",
  col_pattern: "Pattern",
  targets_no_serial: "no serial",
  target_print_or_show: "Print or show the board",
  target_size: "Dark pattern over all",
  target_square: "Square",
  target_step: "Step of the grid",
  target_gap: "Gap between tags",
  target_preview: (name: string) => `The pattern: ${name}`,

  sheet_title: "On paper",
  sheet_detail:
    "The sheet is at true scale. Print it at 100 % (“actual size”), never fitted to the page, and measure both rulers on it before you use it. Glue it flat onto a stiff plate.",
  sheet_paper: "Paper",
  sheet_paper_auto: "the smallest that fits",
  sheet_paper_own: "own size",
  sheet_paper_own_label: "Own size of the paper",
  sheet_paper_own_hint: "width x height, such as 700x500mm",
  sheet_pdf: "Download PDF",
  sheet_svg: "Download SVG",

  screen_title: "On a flat screen",
  screen_detail:
    "A screen serves as a board once its pixels are measured. Take a flat one, at full brightness, without a protective glass before it.",
  screen_unknown: "This screen is not measured yet.",
  screen_known: (density: string) => `This screen has ${density} pixels per mm.`,
  screen_again: "Measure again",
  screen_ratio: (ratio: string) => `Device pixel ratio ${ratio}`,
  screen_ratio_broken:
    "The browser or the system enlarges by a broken number. Sizes stay true; edges are sharpest at a zoom of 100 %.",
  screen_by_card: "With a card",
  screen_by_ruler: "With a ruler",
  screen_card_detail:
    "Hold a bank card or driving licence (85.60 × 53.98 mm) against the screen, at the top left corner of the drawn one, and make the drawn one as large: drag its edge, or use the arrow keys (with Shift by ten pixels).",
  screen_card: "Width of the drawn card",
  screen_card_value: (pixels: number, density: string) => `${pixels} pixels, ${density} per mm`,
  screen_narrower: "Narrower by one pixel",
  screen_wider: "Wider by one pixel",
  screen_ruler_detail:
    "Measure the bar from end to end with a steel ruler. This is more exact than a card: the longer the bar, the better.",
  screen_ruler: "Length of the bar, mm",
  screen_ruler_wrong: "No screen is like that. Measure the bar again, in millimetres.",
  screen_keep: "Keep for this screen",
  screen_kept_note: "Kept in this browser, for this screen and its place among several.",

  show_whole: (spec: string) => `Drawn in whole pixels. Declare it as ${spec}.`,
  show_exact: "Drawn as asked for: whole pixels would change it by half a percent or more.",
  show_check: (size: string, width: string, height: string) =>
    `Check with a ruler: ${size}; dark pattern over all ${width} × ${height}.`,
  show_too_large: (width: string, height: string) =>
    `It does not fit on this screen: with its white border it needs ${width} × ${height}.`,
  show_fits: (spec: string) => `The largest that fits: ${spec}`,
  show_fits_none: "No size of it fits on this screen.",
  show_start: "Show it on the whole screen",
  show_label: (spec: string) => `The target ${spec} at true size`,
  show_declare: "declare",
  show_measure: "measure",
  show_over_all: "over all",
  show_density: (density: string, ratio: string) => `${density} px/mm · device pixel ratio ${ratio}`,
  show_close: "Close",
};
