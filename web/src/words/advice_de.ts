// What each reason of a gate says, in German. The compiler sees to it that it has the codes of the English ones.
import type { About, Advice } from "./advice";
import type { adviceEn } from "./advice_en";

const QUADRANTS: Readonly<Record<string, string>> = {
  "top-left": "oben links",
  "top-right": "oben rechts",
  "bottom-right": "unten rechts",
  "bottom-left": "unten links",
};
const UNDETERMINED =
  "Die Ansichten bestimmen diese Kamera nicht, oder das Linsenmodell passt nicht zu ihr: andere Ansichten mit gekipptem Target aufnehmen, Koeffizienten festhalten, die diese Linse nicht braucht, oder ein anderes Linsenmodell wählen.";
const MORE_TILT =
  "Ansichten hinzufügen, in denen das Target zu beiden Seiten gekippt und nahe an der Kamera ist";

export const adviceDe: Record<keyof typeof adviceEn, Advice> = {
  wrong_target: {
    good: "Kein Bild zeigt ein anderes Target als das angegebene.",
    bad: ({ views }: About) => `Ein anderes Target als das angegebene zeigt: ${views}.`,
    remedy: "Das angegebene Target verwenden oder das verwendete angeben.",
  },
  refused_images: {
    good: "Jedes Bild war brauchbar.",
    bad: ({ views }: About) => `Nicht verwendet: ${views}.`,
    remedy: "Diese Bilder noch einmal aufnehmen oder weglassen.",
  },
  facing: {
    good: "Das Target ist in jeder Ansicht der Kamera zugewandt.",
    bad: ({ views }: About) => `Die Lösung zeigt die Rückseite des Targets in: ${views}.`,
    remedy: "Dieses Bild noch einmal aufnehmen; ist es gespiegelt, die Spiegelung in der Kamera abschalten.",
  },
  nearest_corner: {
    good: "Das Target ist in jeder Ansicht vor der Kamera.",
    bad: ({ views }: About) => `Die Lösung setzt das Target hinter die Kamera in: ${views}.`,
    remedy: "Dieses Bild noch einmal aufnehmen.",
  },
  parity_separation: {
    good: "Dunkle und helle Felder sind in jeder Ansicht klar getrennt.",
    bad: ({ views }: About) => `Dunkle und helle Felder sind kaum zu unterscheiden in: ${views}.`,
    remedy: "Das Target gleichmäßig und ohne Spiegelungen beleuchten und prüfen, ob es das angegebene ist.",
  },
  contrast: {
    good: "Der Kontrast reicht in jeder Ansicht.",
    bad: ({ views }: About) => `Dunkle und helle Felder unterscheiden sich zu wenig in: ${views}.`,
    remedy: "Mehr Licht geben oder länger belichten.",
  },
  saturated_share: {
    good: "Kaum ein helles Feld ist gesättigt.",
    bad: ({ views }: About) =>
      `Helle Felder sind gesättigt, sodass nicht mehr zu sehen ist, wie das Licht fiel: ${views}.`,
    remedy: "Die Lampe dimmen, das Fenster verdunkeln oder kürzer belichten, dann noch einmal aufnehmen.",
  },
  edge_width_px: {
    good: "Jede Ansicht ist scharf.",
    bad: ({ views }: About) => `Unscharf: ${views}.`,
    remedy: ({ views }: About) =>
      `Noch einmal aufnehmen: ${views}. Das Target still halten, kürzer belichten oder es weiter weg halten.`,
  },
  blurred_lens: {
    good: "Jede Ansicht ist scharf.",
    bad: ({ fact }: About) => `${fact("count")} von ${fact("of")} Ansichten sind unscharf.`,
    remedy: "Die Linse scharf stellen, dann die Ansichten noch einmal aufnehmen.",
  },
  quadrant_ratio: {
    good: "Alle Quadranten sind so scharf wie die Mitte.",
    bad: ({ fact }: About) =>
      `Das Bild ist ${QUADRANTS[fact("quadrant")] ?? fact("quadrant")} unschärfer als in der Mitte: die Linse ist verkippt oder dezentriert.`,
    remedy: "Prüfen, wie die Linse sitzt und scharf gestellt ist.",
  },
  missing_poses: {
    good: "Jede vorgeschriebene Pose wurde aufgenommen.",
    bad: ({ poses }: About) => `Nicht aufgenommen: ${poses}.`,
    remedy: "An jeder dieser Posen ein Bild aufnehmen.",
  },
  early_finish: {
    good: ({ fact }: About) =>
      `${fact("taken")} Posen haben die geforderte Genauigkeit bewiesen; ${fact("not_needed")} vorgeschriebene wurden nicht gebraucht.`,
  },
  match_px: {
    good: "Jede Ansicht liegt auf ihrer Sollpose.",
    bad: ({ views }: About) =>
      views === "" ? "Keine Ansicht liegt auf ihrer Sollpose." : `Zu weit von der Sollpose: ${views}.`,
    remedy: "Noch einmal aufnehmen, näher an der gezeigten Pose.",
  },
  view_separation_px: {
    good: "Keine Ansicht ist doppelt.",
    bad: ({ views }: About) =>
      `Diese zeigen das Target am selben Platz und sagen nicht mehr als eine: ${views}.`,
    remedy: "Eine davon weglassen und das Target zwischen den Bildern bewegen.",
  },
  image_coverage: {
    good: "Der Teil des Bildes, in dem Ecken gesehen wurden; nur dort gilt die Kalibrierung.",
  },
  coverage: {
    good: "Die Ansichten decken die Arbeitszone ab.",
    bad: "Teile der Arbeitszone wurden nie gesehen.",
    remedy: "Ansichten mit dem Target zum Bildrand hin hinzufügen.",
  },
  rms_px: {
    good: "Target, Linsenmodell und Ecken passen zusammen.",
    bad: "Die Ecken passen nicht zum Modell.",
    remedy:
      "Prüfen, ob alle Bilder von einer Kamera und unskaliert sind, ob das Target das angegebene, steif und eben ist und ob sich bei den Aufnahmen nichts bewegt hat.",
  },
  rms_no_optimum: {
    good: "Target, Linsenmodell und Ecken passen zusammen.",
    bad: "Die Ecken passen nicht zum Modell.",
    remedy: ({ fact }: About) =>
      `Zuerst die Prüfung des Modells ansehen: das Linsenmodell ${fact("lens")} beschreibt diese Linse vielleicht nicht.`,
  },
  rms_bent_board: {
    good: "Target, Linsenmodell und Ecken passen zusammen.",
    bad: "Die Ecken passen nicht zum Modell.",
    remedy: ({ share }: About) =>
      `Die Residuen wiederholen sich mit den Ecken des Targets, das wohl nicht eben ist (gebogen um etwa ${share("bend")} eines Feldes). Das Muster auf eine steife, ebene Platte aufziehen.`,
  },
  rms_other_lens: {
    good: "Target, Linsenmodell und Ecken passen zusammen.",
    bad: "Die Ecken passen nicht zum Modell.",
    remedy: ({ fact }: About) =>
      `Die Residuen wiederholen sich mit dem Abstand von der Bildmitte; das Linsenmodell ${fact("lens")} beschreibt diese Linse also nicht (ein Fischauge oder eine sehr weite Linse?). Ein anderes Linsenmodell wählen: rational8 für eine weite Linse, kannala_brandt4 für ein Fischauge.`,
  },
  smallest_rms_px: {
    good: "Die Residuen sind so groß, wie echte Ecken sie machen.",
    bad: "Die Ecken passen besser, als Ecken echter Bilder es können: sie wurden berechnet oder kopiert.",
    remedy: "Bilder der Kamera verwenden.",
  },
  worst_view_ratio: {
    good: "Keine Ansicht passt viel schlechter als die anderen.",
    bad: ({ views }: About) => `Passt viel schlechter als die anderen Ansichten: ${views}.`,
    remedy: ({ views }: About) => `Die Ecken von ${views} ansehen und noch einmal aufnehmen.`,
  },
  outlier_share: {
    good: "Kaum eine Ecke liegt daneben.",
    bad: "Zu viele Ecken liegen mehr als vier Sigma daneben.",
    remedy: "Nach Spiegelungen, Schmutz oder etwas vor dem Target suchen.",
  },
  board_bend: {
    good: ({ share }: About) =>
      `Form des Targets aus seiner Ebene heraus, die am besten passt, von Spitze zu Spitze; sie erklärt ${share("share")} der quadrierten Residuen.`,
  },
  focal_sd_share: {
    good: "Die Brennweite ist gut bestimmt.",
    bad: "Die Brennweite ist zu unsicher.",
    remedy: `${MORE_TILT}.`,
  },
  centre_sd_px: {
    good: "Der Bildhauptpunkt ist gut bestimmt.",
    bad: "Der Bildhauptpunkt ist zu unsicher.",
    remedy: `${MORE_TILT}, und solche mit um etwa 90 Grad gedrehtem Target.`,
  },
  zone_mapping_px: {
    good: "Der erwartete Abbildungsfehler in der Arbeitszone ist klein.",
    bad: "Punkte der Arbeitszone würden zu ungenau abgebildet.",
    remedy: "Ansichten hinzufügen, vor allem dort, wo die Arbeitszone kaum abgedeckt ist.",
  },
  valid_mapping_px: {
    good: "Der erwartete Abbildungsfehler ist im ganzen gültigen Bereich klein.",
    bad: "Am Rand des gültigen Bereichs ist die Abbildung zu unsicher.",
    remedy: "Ansichten mit dem Target in den Bildecken hinzufügen.",
  },
  converged: {
    good: "Der Löser hat bewiesen, dass er das Optimum erreicht hat.",
    bad: "Der Löser erreichte nicht von jedem Start dasselbe Optimum.",
    remedy: UNDETERMINED,
  },
  agreement_px: {
    good: "Alle Starts des Lösers führen zur selben Kamera.",
    bad: "Verschiedene Starts des Lösers führen zu verschiedenen Kameras.",
    remedy: UNDETERMINED,
  },
  monotone_ratio: {
    good: "Die Verzeichnung wächst stetig bis über die fernste Ecke hinaus.",
    bad: "Die Verzeichnung faltet sich im Bild zurück, sodass zwei Richtungen ein Pixel teilen.",
    remedy:
      "Die Linse ist weiter, als dieses Linsenmodell beschreiben kann, oder nahe am Rand wurde keine Ecke gesehen: Ansichten mit dem Target in den Bildecken hinzufügen. Ein anderes Linsenmodell wählen: rational8 für eine weite Linse, kannala_brandt4 für ein Fischauge.",
  },
  square_pixels: {
    good: "fx und fy stehen im Verhältnis, das die Pixel ihnen geben.",
    bad: "Das Verhältnis von fx zu fy stimmt nicht: Bild oder Felder wurden gestreckt.",
    remedy: "Das Target nachmessen und ohne Skalierung aufnehmen.",
  },
  bias_ratio: {
    good: "Die Restfehler sind so klein wie das Rauschen der Ecken allein.",
    bad: "Ein Teil der Restfehler ist kein Rauschen: Das Modell lässt etwas übrig.",
    remedy:
      "Prüfen, ob das Target eben und steif ist und ob das Objektivmodell zum Objektiv passt; ein geprüftes Target auf einer Glas- oder Aluminiumplatte zeigt, was von beidem es ist.",
  },
  neighbour_correlation: {
    good: "Die Restfehler benachbarter Ecken haben nichts gemeinsam.",
    bad: "Benachbarte Ecken liegen in dieselbe Richtung daneben, das ist kein Rauschen.",
    remedy:
      "Prüfen, ob das Target eben und steif ist und ob das Objektivmodell zum Objektiv passt; ein geprüftes Target auf einer Glas- oder Aluminiumplatte zeigt, was von beidem es ist.",
  },
  half_difference: {
    good: "Hälften der Ansichten führen zur selben Kamera, soweit das Rauschen es zulässt.",
    bad: "Hälften der Ansichten führen zu verschiedenen Kameras.",
    remedy:
      "Prüfen, ob alle Bilder von dieser einen Kamera sind, ihr Objektiv fest und scharf gestellt ist und die Seriennummer stimmt; dann die Ansichten neu aufnehmen.",
  },
  held_out_ratio: {
    good: "Jede Ansicht passt zu der Kamera, die die anderen finden.",
    bad: ({ views }: About) => `Passt am wenigsten zu der Kamera, die die anderen finden: ${views}.`,
    remedy: ({ views }: About) =>
      `Neu aufnehmen oder ähnliche Ansichten hinzufügen: ${views} entscheidet allein zu viel.`,
  },
  focal_off_share: {
    good: "Die Brennweite ist die der SKU.",
    bad: "Die Brennweite ist nicht die der SKU.",
    remedy:
      "Prüfen, ob die Kamera von dieser SKU ist, die Bilder nicht skaliert sind und der Nennwert stimmt.",
  },
  centre_off_px: {
    good: "Der Bildhauptpunkt liegt dort, wo die SKU ihn hat.",
    bad: "Der Bildhauptpunkt liegt nicht dort, wo die SKU ihn hat.",
    remedy:
      "Prüfen, ob das Objektiv nicht verschoben ist, die Bilder nicht beschnitten sind und der Nennwert stimmt.",
  },
  other_sku: {
    good: "Keine andere SKU passt besser zu dieser Kamera.",
    bad: ({ fact }: About) => `Diese Kamera sieht aus wie eine der SKU ${fact("sku")}.`,
    remedy: "Prüfen, welche Kamera eingebaut ist, und den Lauf für deren SKU öffnen.",
  },
  population_units: {
    good: ({ fact }: About) =>
      `${fact("count")} von ${fact("of")} Kameras dieser SKU-Revision sind bekannt; bis dahin gelten die Startgrenzen.`,
  },
  population_distance: {
    good: ({ fact }: About) => `Diese Kamera ist wie die ${fact("units")} anderen ihrer SKU.`,
    bad: ({ fact }: About) =>
      `Diese Kamera ist anders als die ${fact("units")} anderen ihrer SKU: ${fact("parameter")} liegt ${fact("deviations")} Standardabweichungen daneben, weiter als jeder andere Parameter.`,
    remedy:
      "Prüfen, ob die Kamera von dieser SKU ist und ihr Objektiv richtig sitzt. Wurden Teile geändert, eine Revision der SKU anlegen: ihre Population beginnt neu.",
  },
  other_population: {
    good: "Die angegebene SKU erklärt diese Kamera am besten.",
    bad: ({ fact }: About) => `Diese Kamera ist weit eher eine der SKU ${fact("sku")}.`,
    remedy: "Prüfen, welche Kamera verbaut ist, und den Lauf für deren SKU öffnen.",
  },
  other_population_twin: {
    good: ({ fact }: About) =>
      `Kameras der SKU ${fact("sku")} gleichen diesen so sehr, dass kein Bild sie unterscheidet.`,
    bad: ({ fact }: About) => `Diese Kamera ist weit eher eine der SKU ${fact("sku")}.`,
    remedy: "Prüfen, welche Kamera verbaut ist, und den Lauf für deren SKU öffnen.",
  },
  used_elsewhere: {
    good: "Kein Bild wurde für eine andere Seriennummer benutzt.",
    bad: ({ views }: About) => `Schon für eine andere Seriennummer benutzt: ${views}.`,
    remedy: "Prüfen, welche Kamera die Station liest, und die Bilder der Kamera dieses Fahrzeugs aufnehmen.",
  },
  translation_sd_mm: {
    good: "Die Position der Kamera im Fahrzeug ist gut bestimmt.",
    bad: "Die Position der Kamera im Fahrzeug ist unsicher.",
    remedy:
      "Ein größeres festes Target verwenden oder eines, das näher an der Kamera und gegen sie gekippt steht, und seinen Ort neu vermessen.",
  },
  rotation_sd_mdeg: {
    good: "Die Blickrichtung der Kamera im Fahrzeug ist gut bestimmt.",
    bad: "Die Blickrichtung der Kamera im Fahrzeug ist unsicher.",
    remedy:
      "Ein größeres festes Target verwenden oder eines, das näher an der Kamera und gegen sie gekippt steht, und seinen Ort neu vermessen.",
  },
  mounting_off_mm: {
    good: "Die Kamera ist, wo sie hingehört.",
    bad: "Die Kamera ist nicht, wo sie hingehört.",
    remedy: "Einbau der Kamera prüfen, und ob das Target der Station dort steht, wo es angegeben ist.",
  },
  mounting_off_mdeg: {
    good: "Die Kamera blickt, wohin sie soll.",
    bad: "Die Kamera blickt nicht, wohin sie soll.",
    remedy: "Einbau der Kamera prüfen, und ob das Target der Station dort steht, wo es angegeben ist.",
  },
  extrinsics_rms_px: {
    good: "Die Ecken des festen Targets passen zu seiner Pose.",
    bad: "Die Ecken des festen Targets passen nicht zu seiner Pose.",
    remedy: "Prüfen, ob das feste Target das angegebene und eben ist und nichts es verdeckt.",
  },
  image_agreement_px: {
    good: "Alle Bilder zeigen das feste Target am selben Ort.",
    bad: "Kamera oder festes Target haben sich zwischen den Bildern bewegt.",
    remedy: "Das Fahrzeug ruhig stehen lassen, dann die Bilder des festen Targets noch einmal aufnehmen.",
  },
  tilt_ambiguity: {
    good: "Nur eine Neigung des festen Targets erklärt seine Ecken.",
    bad: "Zwei Neigungen des festen Targets erklären seine Ecken fast gleich gut.",
    remedy:
      "Ein größeres festes Target verwenden oder eines, das näher an der Kamera und gegen sie gekippt steht.",
  },
  paper_score: { good: "Die Gütezahl der Vorlage gegen die Nennkamera der SKU; höher ist näher." },
  nominal_difference_px: {
    good: "Wie weit diese Kamera die Arbeitszone anders abbildet als die Nennkamera der SKU.",
  },
};
