// Entry of kiosk.html: what must be known before the first drawing, then the drawing.
import "../look/tokens.css";
import "../look/page.css";
import "../look/notices.css";
import "../look/kiosk.css";
import "../look/kiosk_figures.css";
import "../look/kiosk_accuracy.css";
import "../look/kiosk_guide.css";
import "../look/kiosk_hand.css";
import "../look/kiosk_pictograms.css";
import "../look/kiosk_verdict.css";
import "../look/kiosk_idle.css";
import "../look/kiosk_practice.css";
import "../look/kiosk_large.css";
import { render } from "preact";
import { takeKeyFromAddress } from "../api/key";
import { showFirstTheme } from "../look/theme";
import { speakFirstLanguage } from "../words/language";
import { App } from "./app";

takeKeyFromAddress();
showFirstTheme();
speakFirstLanguage();

const place = document.getElementById("app");
if (place === null) throw new Error("kiosk.html has no element with id app");
render(<App named={new URLSearchParams(window.location.search).get("station")} />, place);
