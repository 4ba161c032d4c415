// Every text in German about a station's boards with their shapes, its fixture and what that tells later.
import type { enBoards } from "./en_boards";

export const deBoards: typeof enBoards = {
  station_board: "Tafel",
  station_board_none: "keine genannt",
  station_board_flat: "gilt als eben",
  station_board_certified: (version, when, runs) =>
    `Form ${version}, zertifiziert ${when}, aus ${runs} Läufen`,
  station_board_open: "Form",
  station_board_open_of: (board) => `Form der Tafel ${board}`,

  board_title: (board) => `Tafel ${board}`,
  board_all: "Alle Tafeln",
  board_in_use: (version, when) =>
    `An den Stationen dieser Tafel wird mit ihrer Form ${version} gerechnet, zertifiziert ${when}.`,
  board_flat:
    "Gerechnet wird, als wäre diese Tafel eben. Das ist keine Platte: Eine gelernte Form zertifizieren, dann wird von da an mit ihr gerechnet.",
  board_steady: (moved, limit) =>
    `Die neueste Form weicht um ${moved} mm von der zertifizierten ab; ${limit} mm sind erlaubt.`,

  shapes_title: "Formen",
  shapes_note: "neueste zuerst; eine wählen, um sie zu sehen",
  shapes_none: "Noch keine Form gelernt.",
  shapes_caption: "Die Formen dieser Tafel, neueste zuerst",
  shape_version: (version) => `Form ${version}`,
  shape_col_version: "Form",
  shape_col_state: "Zustand",
  shape_col_learnt: "Gelernt",
  shape_col_runs: "Läufe",
  shape_col_bend: "Biegung",
  shape_col_certainty: "Ecken ±",
  shape_col_drift: "Verschoben",
  shape_draft: "gelernt",
  shape_certified: "zertifiziert",
  shape_retired: "abgelöst",
  shape_since: (when, who) => `seit ${when}, durch ${who}`,
  shape_drift_steady: "ruhig",
  shape_drift_near: "nahe der Grenze",
  shape_drift_over: "über der Grenze",

  shape_heights: "Höhe über der Tafel",
  shape_heights_note: "zur Kamera hin, über der tiefsten Ecke",
  shape_corner: (corner, height, sd) => `Ecke ${corner}: ${height} ± ${sd} µm`,
  shape_bend: "Biegung, Spitze zu Spitze",
  shape_in_plane: "Weiteste in der Ebene",
  shape_corner_sd: "Ecken bekannt auf (1 sd)",
  shape_noise: "Rauschen der Ecken, eben → diese Form",
  shape_camera_sd: "Allen Kameras gemeinsam (1 sd)",
  shape_camera_sd_note: "Brennweite / Zentrum / Abbildung",
  shape_by: "Gelernt durch",
  shape_certified_fact: "Zertifiziert",
  shape_retired_fact: "Abgelöst",

  shape_certify: "Zertifizieren",
  shape_certify_ask: "Diese Form zertifizieren?",
  shape_certify_detail: (board) =>
    `An den Stationen von ${board} wird von jetzt an mit ihr gerechnet, und die Form davor wird abgelöst. Frühere Ergebnisse bleiben, wie sie sind.`,
  shape_retire: "Zurückziehen",
  shape_retire_ask: "Diese Form zurückziehen?",
  shape_retire_certified: (board) =>
    `An den Stationen von ${board} gilt die Tafel wieder als eben, bis eine andere Form zertifiziert wird. Frühere Ergebnisse bleiben, wie sie sind. Eine zurückgezogene Form kommt nicht wieder.`,
  shape_retire_draft:
    "Sie kann dann nicht mehr zertifiziert werden. Eine zurückgezogene Form kommt nicht wieder.",
  shape_leave: "So lassen",

  learn_title: "Form lernen",
  learn_detail:
    "Aus den letzten beendeten Läufen an Stationen mit dieser Tafel, im Hintergrund. Das Gelernte wird erst nach dem Zertifizieren benutzt; mehr Läufe kennen die Ecken besser.",
  learn_runs: "Aus wie vielen Läufen",
  learn_start: "Lernen",
  learn_running: (percent) => `Die Form wird gelernt: ${percent}`,

  drift_title: "Drift",
  drift_note: "weiteste Ecke, mm, von der damals zertifizierten Form",
  drift_key: "● ruhig ▲ nahe ◆ darüber · ┄ Grenze",
  drift_chart: (count) =>
    `Weiteste Verschiebung einer Ecke über ${count} gelernte Formen; die Zahlen stehen in der Tabelle der Formen`,
  drift_read: (version, when, moved, focal) =>
    `Form ${version}, ${when}: ${moved} mm, Brennweite um ${focal} px daneben`,

  fixture: "Festes Target",
  fixture_of: (code) => `Festes Target von ${code}`,
  fixture_none: "keines",
  fixture_place: (position) => `bei ${position} mm`,
  fixture_set: "Angeben",
  fixture_hint:
    "Wo ein festes Target im Fahrzeugsystem steht (T_vehicle_board), wenn ein Fahrzeug in der Station ist. Es gilt für Bilder, die ab jetzt aufgenommen werden; Ergebnisse behalten, womit sie gerechnet wurden.",
  fixture_target: "Muster",
  fixture_target_hint: "etwa chessboard:9x6:40mm",
  fixture_position: "Position der Ecke 0, mm",
  fixture_position_axis: (axis) => `Position ${axis}, mm`,
  fixture_rotation: "Rotationsvektor, °",
  fixture_rotation_axis: (axis) => `Rotation ${axis}, °`,
  fixture_certainty: "Bekannt auf (1 sd)",
  fixture_translation_sd: "Position ±, mm",
  fixture_rotation_sd: "Rotation ±, mdeg",
  fixture_remove: "Entfernen",
  fixture_remove_ask: "Das feste Target entfernen?",
  fixture_remove_detail: (code) =>
    `Bilder eines festen Targets werden an ${code} von jetzt an abgelehnt, und neue Läufe dort sagen nicht, wo die Kamera im Fahrzeug ist. Frühere Ergebnisse bleiben, wie sie sind.`,

  later_extrinsics_title: "Lage im Fahrzeug, nach dem Lauf",
  later_extrinsics_when: (when, station) => `${when} an ${station}`,
};
