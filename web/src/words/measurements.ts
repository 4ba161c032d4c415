// Names of measurements and gates in words. A name that is not listed (a newer service) is shown as it came.
import type { Words } from "./en";
import type { Language } from "./language";

type Name = Record<Language, string>;

const NAMES: Readonly<Record<string, Name>> = {
  wrong_target: { en: "Images of another board", de: "Bilder eines anderen Targets" },
  refused_images: { en: "Refused images", de: "Abgelehnte Bilder" },
  facing: { en: "Facing the camera (cosine)", de: "Der Kamera zugewandt (Kosinus)" },
  nearest_corner: { en: "Nearest corner in front", de: "Nächste Ecke vor der Kamera" },
  parity_separation: { en: "Black and white apart", de: "Abstand Schwarz–Weiß" },
  contrast: { en: "Contrast", de: "Kontrast" },
  edge_width_px: { en: "Edge width 10–90 %", de: "Kantenbreite 10–90 %" },
  quadrant_ratio: { en: "Worst quadrant / centre", de: "Schlechtester Quadrant / Mitte" },
  missing_poses: { en: "Poses not taken", de: "Fehlende Posen" },
  match_share: {
    en: "Match to the asked pose / image width",
    de: "Abweichung von der Sollpose / Bildbreite",
  },
  match_px: { en: "Match to the asked pose", de: "Abweichung von der Sollpose" },
  view_separation_px: { en: "Distance of nearest views", de: "Abstand der nächsten Ansichten" },
  image_coverage: { en: "Coverage of the image", de: "Abdeckung des Bildes" },
  coverage: { en: "Coverage of the zone", de: "Abdeckung der Zone" },
  rms_px: { en: "RMS error", de: "RMS-Fehler" },
  smallest_rms_px: { en: "RMS plausible", de: "RMS plausibel" },
  worst_view_ratio: { en: "Worst / median view", de: "Schlechteste / mittlere Ansicht" },
  outlier_share: { en: "Outliers beyond 4σ", de: "Ausreißer über 4σ" },
  board_bend: { en: "Bend of the board", de: "Biegung des Targets" },
  focal_sd_share: { en: "sd of focal length", de: "Std.-Abw. Brennweite" },
  centre_sd_px: { en: "sd of principal point", de: "Std.-Abw. Bildhauptpunkt" },
  zone_mapping_px: { en: "Mapping error, zone", de: "Abbildungsfehler, Zone" },
  valid_mapping_px: { en: "Mapping error, worst", de: "Abbildungsfehler, größter" },
  converged: { en: "Optimum proven", de: "Optimum bewiesen" },
  agreement_px: { en: "Agreement of starts", de: "Übereinstimmung der Starts" },
  monotone_ratio: { en: "Distortion monotone to", de: "Verzeichnung monoton bis" },
  square_pixels: { en: "|fx / fy − 1|", de: "|fx / fy − 1|" },
  bias_ratio: { en: "Residuals that are no noise", de: "Restfehler, die kein Rauschen sind" },
  neighbour_correlation: { en: "Correlation of neighbours", de: "Korrelation der Nachbarn" },
  half_difference: { en: "Halves apart / expected", de: "Abstand der Hälften / erwartet" },
  held_out_ratio: { en: "Held-out view / fit", de: "Ausgelassene Ansicht / Anpassung" },
  focal_off_share: { en: "Focal length from nominal", de: "Brennweite zum Nennwert" },
  centre_off_px: { en: "Principal point from nominal", de: "Bildhauptpunkt zum Nennwert" },
  other_sku: { en: "Nearer to another SKU", de: "Näher an einer anderen SKU" },
  used_elsewhere: { en: "Pictures of another serial", de: "Bilder einer anderen Seriennummer" },
  paper_score: { en: "Score S of the paper", de: "Gütezahl S der Vorlage" },
  nominal_difference_px: { en: "Distance from nominal", de: "Abstand vom Nennwert" },
};

const UNITS: Readonly<Record<string, Name>> = {
  "grey levels": { en: "grey levels", de: "Graustufen" },
  images: { en: "images", de: "Bilder" },
  poses: { en: "poses", de: "Posen" },
  squares: { en: "squares", de: "Felder" },
};

/** Words among the units in the language; px, m and the like stay as they are. */
export function unitName(unit: string, language: Language): string {
  return UNITS[unit]?.[language] ?? unit;
}

export function measurementName(name: string, language: Language): string {
  return NAMES[name]?.[language] ?? name.replaceAll("_", " ");
}

export function gateName(gate: string, words: Words): string {
  const text: unknown = (words as Record<string, unknown>)[`gate_${gate}`];
  return typeof text === "string" ? text : gate;
}

export function purposeName(purpose: string, words: Words): string {
  const text: unknown = (words as Record<string, unknown>)[`purpose_${purpose}`];
  return typeof text === "string" ? text : purpose;
}

export function provenanceName(name: string, words: Words): string {
  const text: unknown = (words as Record<string, unknown>)[`provenance_${name}`];
  return typeof text === "string" ? text : name.replaceAll("_", " ");
}
