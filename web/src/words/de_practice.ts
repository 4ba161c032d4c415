// Every text in German around the runs of a kiosk: practice, the screen while nobody is there, voice, full screen,
// and the language of a station.
import type { enPractice } from "./en_practice";

export const dePractice: typeof enPractice = {
  practice_open: "Üben",
  practice_title: "Üben",
  practice_detail:
    "Ein Lauf gegen die Uhr, mit Punkten. Er zählt für kein Fahrzeug und keine Ausbeute. Die eigene Bestleistung bleibt in diesem Browser, und nur der eigene Ausweis zeigt sie.",
  practice_badge: "Ausweis",
  practice_badge_hint: "Ausweis scannen oder leer lassen: dann wird keine Bestleistung behalten.",
  practice_start: "Übung beginnen",
  practice_leave: "Zurück",
  practice_word: "Übung",
  practice_points: "Punkte",
  practice_streak: "In Folge unter Sollzeit",
  practice_time: "Diese Pose",
  practice_par: (seconds) => `Soll ${seconds} s`,
  practice_over: "über Sollzeit",
  practice_under: "unter Sollzeit",
  practice_best: "Eigene Bestleistung",
  practice_best_none: "noch keine",
  practice_seconds: (seconds) => `${seconds} s`,
  practice_done: "Die Übung ist zu Ende",
  practice_of: (points, most) => `${points} von ${most} Punkten`,
  practice_new_best: "Neue eigene Bestleistung!",
  practice_not_whole: "Die Seite wurde zwischendurch geladen; dieser Lauf ist keine Bestleistung.",
  practice_not_passed: "Die Bilder hätten nicht bestanden; dieser Lauf ist keine Bestleistung.",
  practice_total: "Zeit",
  practice_total_of: (took, par) => `${took} s, Soll ${par} s`,
  practice_under_par: "Posen unter Sollzeit",
  practice_under_par_of: (count, all) => `${count} von ${all}`,
  practice_longest: "Längste Folge",
  practice_verdict: "Diese Bilder wären",
  practice_again: "Noch einmal",
  practice_end: "Fertig",

  idle_title: "Bereit für das nächste Fahrzeug",
  idle_detail: "Etikett scannen. Jede Taste oder Berührung weckt den Bildschirm.",

  act_speech: "Stimme",
  act_full_screen: "Vollbild",

  station_language: "Kiosk spricht",
  station_language_of: (code) => `Kiosk von ${code} spricht`,
  station_language_none: "wie der Browser",
};
