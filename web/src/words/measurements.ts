// Names of measurements and gates in words. A name that is not listed (a newer service) is shown as it came.
import type { Words } from "./en";
import type { Language } from "./language";

type Name = Record<Language, string>;

const NAMES: Readonly<Record<string, Name>> = {
  wrong_target: {
    en: "Images of another board",
    de: "Bilder eines anderen Targets",
    zh: "含其他标定板的图像",
  },
  refused_images: { en: "Refused images", de: "Abgelehnte Bilder", zh: "被拒绝的图像" },
  facing: { en: "Facing the camera (cosine)", de: "Der Kamera zugewandt (Kosinus)", zh: "朝向相机（余弦）" },
  nearest_corner: { en: "Nearest corner in front", de: "Nächste Ecke vor der Kamera", zh: "最近角点在前方" },
  parity_separation: { en: "Black and white apart", de: "Abstand Schwarz–Weiß", zh: "黑白区分度" },
  contrast: { en: "Contrast", de: "Kontrast", zh: "对比度" },
  saturated_share: {
    en: "Saturated share of bright squares",
    de: "Gesättigter Anteil heller Felder",
    zh: "白色方格过曝比例",
  },
  edge_width_px: { en: "Edge width 10–90 %", de: "Kantenbreite 10–90 %", zh: "边缘宽度 10–90 %" },
  quadrant_ratio: {
    en: "Worst quadrant / centre",
    de: "Schlechtester Quadrant / Mitte",
    zh: "最差象限 / 中心",
  },
  missing_poses: { en: "Poses not taken", de: "Fehlende Posen", zh: "未采集的位姿" },
  match_share: {
    en: "Match to the asked pose / image width",
    de: "Abweichung von der Sollpose / Bildbreite",
    zh: "与目标位姿的偏差 / 图像宽度",
  },
  match_px: { en: "Match to the asked pose", de: "Abweichung von der Sollpose", zh: "与目标位姿的偏差" },
  view_separation_px: {
    en: "Distance of nearest views",
    de: "Abstand der nächsten Ansichten",
    zh: "最近视图的间距",
  },
  image_coverage: { en: "Coverage of the image", de: "Abdeckung des Bildes", zh: "图像覆盖" },
  coverage: { en: "Coverage of the zone", de: "Abdeckung der Zone", zh: "工作区覆盖" },
  rms_px: { en: "RMS error", de: "RMS-Fehler", zh: "RMS 误差" },
  smallest_rms_px: { en: "RMS plausible", de: "RMS plausibel", zh: "RMS 合理性" },
  worst_view_ratio: {
    en: "Worst / median view",
    de: "Schlechteste / mittlere Ansicht",
    zh: "最差 / 中位视图",
  },
  outlier_share: { en: "Outliers beyond 4σ", de: "Ausreißer über 4σ", zh: "超过 4σ 的离群点" },
  board_bend: { en: "Bend of the board", de: "Biegung des Targets", zh: "标定板弯曲" },
  focal_sd_share: { en: "sd of focal length", de: "Std.-Abw. Brennweite", zh: "焦距标准差" },
  centre_sd_px: { en: "sd of principal point", de: "Std.-Abw. Bildhauptpunkt", zh: "主点标准差" },
  zone_mapping_px: { en: "Mapping error, zone", de: "Abbildungsfehler, Zone", zh: "映射误差，工作区" },
  valid_mapping_px: { en: "Mapping error, worst", de: "Abbildungsfehler, größter", zh: "映射误差，最大" },
  converged: { en: "Optimum proven", de: "Optimum bewiesen", zh: "最优已证明" },
  agreement_px: { en: "Agreement of starts", de: "Übereinstimmung der Starts", zh: "各起点一致性" },
  monotone_ratio: { en: "Distortion monotone to", de: "Verzeichnung monoton bis", zh: "畸变单调至" },
  square_pixels: { en: "|fx / fy − 1|", de: "|fx / fy − 1|", zh: "|fx / fy − 1|" },
  bias_ratio: {
    en: "Residuals that are no noise",
    de: "Restfehler, die kein Rauschen sind",
    zh: "非噪声残差",
  },
  neighbour_correlation: {
    en: "Correlation of neighbours",
    de: "Korrelation der Nachbarn",
    zh: "相邻相关性",
  },
  half_difference: {
    en: "Halves apart / expected",
    de: "Abstand der Hälften / erwartet",
    zh: "两半之差 / 预期",
  },
  held_out_ratio: {
    en: "Held-out view / fit",
    de: "Ausgelassene Ansicht / Anpassung",
    zh: "留出视图 / 拟合",
  },
  focal_off_share: { en: "Focal length from nominal", de: "Brennweite zum Nennwert", zh: "焦距与标称之差" },
  centre_off_px: {
    en: "Principal point from nominal",
    de: "Bildhauptpunkt zum Nennwert",
    zh: "主点与标称之差",
  },
  other_sku: { en: "Nearer to another SKU", de: "Näher an einer anderen SKU", zh: "更接近其他 SKU" },
  population_units: {
    en: "Cameras known of the SKU",
    de: "Bekannte Kameras der SKU",
    zh: "已知的同 SKU 相机",
  },
  population_distance: {
    en: "Distance from the SKU’s cameras (χ²)",
    de: "Abstand von den Kameras der SKU (χ²)",
    zh: "与同 SKU 相机的距离（χ²）",
  },
  other_population: {
    en: "Likelier of another SKU (−2 ln)",
    de: "Eher von einer anderen SKU (−2 ln)",
    zh: "更可能属于其他 SKU（−2 ln）",
  },
  used_elsewhere: {
    en: "Pictures of another serial",
    de: "Bilder einer anderen Seriennummer",
    zh: "属于其他序列号的图像",
  },
  translation_sd_mm: { en: "sd of position", de: "Std.-Abw. Position", zh: "位置标准差" },
  rotation_sd_mdeg: { en: "sd of direction", de: "Std.-Abw. Richtung", zh: "朝向标准差" },
  mounting_off_mm: { en: "Position from nominal", de: "Position zum Nennwert", zh: "位置与标称之差" },
  mounting_off_mdeg: { en: "Direction from nominal", de: "Richtung zum Nennwert", zh: "朝向与标称之差" },
  extrinsics_rms_px: {
    en: "RMS error of the fixed target",
    de: "RMS-Fehler des festen Targets",
    zh: "固定标定板 RMS 误差",
  },
  image_agreement_px: { en: "Agreement of pictures", de: "Übereinstimmung der Bilder", zh: "图像一致性" },
  tilt_ambiguity: {
    en: "Other tilt as likely",
    de: "Andere Neigung so wahrscheinlich",
    zh: "另一种倾斜的可能性",
  },
  paper_score: { en: "Score S of the paper", de: "Gütezahl S der Vorlage", zh: "论文评分 S" },
  nominal_difference_px: { en: "Distance from nominal", de: "Abstand vom Nennwert", zh: "与标称的距离" },
};

const UNITS: Readonly<Record<string, Name>> = {
  "grey levels": { en: "grey levels", de: "Graustufen", zh: "灰度级" },
  images: { en: "images", de: "Bilder", zh: "张图像" },
  poses: { en: "poses", de: "Posen", zh: "个位姿" },
  units: { en: "units", de: "Stück", zh: "台" },
  squares: { en: "squares", de: "Felder", zh: "格" },
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
