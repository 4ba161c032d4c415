// Entry of dashboard.html: what must be known before the first drawing, then the drawing.
import "../look/tokens.css";
import "../look/page.css";
import "../look/notices.css";
import "../look/tables.css";
import "../look/run.css";
import "../look/drawings.css";
import "../look/files.css";
import "../look/plant.css";
import "../look/review.css";
import "../look/results.css";
import "../look/targets.css";
import "../look/boards.css";
import { render } from "preact";
import { takeKeyFromAddress } from "../api/key";
import { followKey } from "../api/own_role";
import { showFirstTheme } from "../look/theme";
import { speakFirstLanguage } from "../words/language";
import { App } from "./app";
import { followAddress } from "./address";

takeKeyFromAddress();
showFirstTheme();
speakFirstLanguage();
followKey();
followAddress();

const place = document.getElementById("app");
if (place === null) throw new Error("dashboard.html has no element with id app");
render(<App />, place);
