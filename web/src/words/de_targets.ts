// Every text in German about targets: their list, their sheets to print, and showing one on a screen.
import type { enTargets } from "./en_targets";

export const deTargets: typeof enTargets = {
  nav_targets: "Tafeln",
  targets_title: "Tafeln",
  targets_none: "Noch keine Tafel angemeldet",
  targets_none_detail:
    "Ein Ingenieur meldet die Tafeln des Werks mit POST /api/v1/targets an. Drucken oder zeigen lässt sich jede Tafel auch ohne das: oben benennen.",
  targets_name: "Eine Tafel drucken oder zeigen",
  targets_name_hint: "etwa chessboard:9x6:25mm",
  targets_open: "Öffnen",
  targets_registered: "Angemeldete Tafeln",
  col_pattern: "Muster",
  targets_no_serial: "ohne Seriennummer",
  target_print_or_show: "Tafel drucken oder zeigen",
  target_size: "Dunkles Muster insgesamt",
  target_square: "Feld",
  target_step: "Raster",
  target_gap: "Abstand der Marken",
  target_preview: (name) => `Das Muster: ${name}`,

  sheet_title: "Auf Papier",
  sheet_detail:
    "Das Blatt ist maßstäblich. Mit 100 % drucken („Originalgröße“), nie an die Seite anpassen, und vor dem Gebrauch beide Lineale darauf nachmessen. Plan auf eine steife Platte kleben.",
  sheet_paper: "Papier",
  sheet_paper_auto: "das kleinste passende",
  sheet_paper_own: "eigenes Maß",
  sheet_paper_own_label: "Eigenes Maß des Papiers",
  sheet_paper_own_hint: "Breite x Höhe, etwa 700x500mm",
  sheet_pdf: "PDF herunterladen",
  sheet_svg: "SVG herunterladen",

  screen_title: "Auf einem ebenen Bildschirm",
  screen_detail:
    "Ein Bildschirm dient als Tafel, sobald seine Pixel vermessen sind. Er muss eben sein, voll hell und ohne Schutzglas davor.",
  screen_unknown: "Dieser Bildschirm ist noch nicht vermessen.",
  screen_known: (density) => `Dieser Bildschirm hat ${density} Pixel pro mm.`,
  screen_again: "Neu vermessen",
  screen_ratio: (ratio) => `Gerätepixel-Verhältnis ${ratio}`,
  screen_ratio_broken:
    "Browser oder System vergrößern um eine gebrochene Zahl. Die Maße bleiben richtig; am schärfsten sind Kanten bei Zoom 100 %.",
  screen_by_card: "Mit einer Karte",
  screen_by_ruler: "Mit einem Lineal",
  screen_card_detail:
    "Bankkarte oder Führerschein (85,60 × 53,98 mm) an der oberen linken Ecke der gezeichneten Karte an den Bildschirm halten und die gezeichnete gleich groß machen: am Rand ziehen oder mit den Pfeiltasten (mit Umschalt um zehn Pixel).",
  screen_card: "Breite der gezeichneten Karte",
  screen_card_value: (pixels, density) => `${pixels} Pixel, ${density} pro mm`,
  screen_narrower: "Um ein Pixel schmaler",
  screen_wider: "Um ein Pixel breiter",
  screen_ruler_detail:
    "Den Balken von Ende zu Ende mit einem Stahllineal messen. Das ist genauer als eine Karte: je länger der Balken, desto besser.",
  screen_ruler: "Länge des Balkens, mm",
  screen_ruler_wrong: "So ist kein Bildschirm. Den Balken noch einmal messen, in Millimetern.",
  screen_keep: "Für diesen Bildschirm merken",
  screen_kept_note: "Bleibt in diesem Browser, für diesen Bildschirm und seinen Platz unter mehreren.",

  show_whole: (spec) => `In ganzen Pixeln gezeichnet. Anzugeben ist ${spec}.`,
  show_exact: "Wie verlangt gezeichnet: ganze Pixel würden das Maß um ein halbes Prozent oder mehr ändern.",
  show_check: (size, width, height) =>
    `Mit dem Lineal prüfen: ${size}; dunkles Muster insgesamt ${width} × ${height}.`,
  show_too_large: (width, height) =>
    `Passt nicht auf diesen Bildschirm: mit weißem Rand braucht es ${width} × ${height}.`,
  show_fits: (spec) => `Die größte, die passt: ${spec}`,
  show_fits_none: "In keiner Größe passt sie auf diesen Bildschirm.",
  show_start: "Auf dem ganzen Bildschirm zeigen",
  show_label: (spec) => `Die Tafel ${spec} in wahrer Größe`,
  show_declare: "angeben",
  show_measure: "messen",
  show_over_all: "insgesamt",
  show_density: (density, ratio) => `${density} px/mm · Gerätepixel-Verhältnis ${ratio}`,
  show_close: "Schließen",
};
