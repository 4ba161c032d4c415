// Texte auf Deutsch zu dem, was weiterhilft: erst eine andere Pose, Licht, und das von Hand bewegte Target.
import type { enHelp } from "./en_help";

export const deHelp: typeof enHelp = {
  help_another_first: "Erst eine andere Pose; die vorige kommt später noch einmal",
  help_added_accuracy: "Noch eine Pose, damit das Ergebnis genau wird",
  help_added_weak: "Noch eine Pose statt eines Bildes, das nicht gut genug war",
  help_added_reach: "Eine andere Pose statt der unerreichbaren",
  help_pose_added: (number) => `Zusätzliche Pose ${number}`,
  help_board_away: "Kein Target im Bild. Zum Weitermachen das Target vor die Kamera halten",
  help_more_light: "Zu dunkel für die Kamera: Lampe einschalten oder wegnehmen, was im Licht steht",
  help_less_light: "Das Target spiegelt Licht: Lampe oder Fenster abschatten oder dimmen",
  help_override: "Trotzdem aufnehmen",

  hand_area: "Virtuelles Target: ziehen, um es zu bewegen",
  hand_shift: "Schieben",
  hand_tilt: "Kippen",
  hand_roll: "Drehen",
  hand_help:
    "Ziehen: schieben. Mausrad: näher oder weiter weg. Rechte Taste oder Umschalt: kippen. Q, E oder Alt: drehen. Zwei Finger: alles außer kippen.",
};
