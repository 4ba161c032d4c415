import { defineConfig } from "vitest/config";

const service = process.env["DMSCAL_DEV_SERVICE"] ?? "http://127.0.0.1:8000";

export default defineConfig({
  base: "/",
  build: {
    outDir: "dist",
    emptyOutDir: true,
    target: "es2022",
    modulePreload: { polyfill: false },
    assetsInlineLimit: 0,
    // three.js is one piece of this size, loaded only where poses are shown in space.
    chunkSizeWarningLimit: 600,
    rolldownOptions: { input: { dashboard: "dashboard.html", kiosk: "kiosk.html" } },
  },
  oxc: { jsx: { runtime: "automatic", importSource: "preact" } },
  server: {
    open: "/dashboard.html",
    proxy: {
      "/api": service,
      "/livez": service,
      "/readyz": service,
      "/problems": service,
      "/ws": { target: service, ws: true },
    },
  },
  test: { include: ["src/**/*.test.ts", "scripts/**/*.test.ts"], environment: "node" },
});
