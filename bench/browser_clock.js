// Injected into the kiosk page by the bench `browser`: when each of its frames was grabbed, sent and drawn.
// A worker's clock starts when it is made: taken from before that, a frame's age comes out too large, never small.
(() => {
  const seen = { grabbed: new Map(), drawn: [] };
  window.benchSeen = seen;
  let workerBegan = 0;
  window.Worker = class extends window.Worker {
    constructor(...given) {
      workerBegan = performance.now();
      super(...given);
    }
  };
  const send = WebSocket.prototype.send;
  WebSocket.prototype.send = function (message) {
    if (message instanceof ArrayBuffer || ArrayBuffer.isView(message)) {
      const bytes = message instanceof ArrayBuffer ? new Uint8Array(message) : new Uint8Array(message.buffer);
      const length = new DataView(bytes.buffer).getUint32(0, true);
      const head = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
      if (!head.full) seen.grabbed.set(head.sequence, workerBegan + head.at_ms);
    }
    return send.call(this, message);
  };
  const Socket = window.WebSocket;
  window.WebSocket = class extends Socket {
    constructor(...given) {
      super(...given);
      this.addEventListener("message", ({ data }) => {
        if (typeof data !== "string") return;
        const told = JSON.parse(data);
        const grabbed = told.type === "state" ? seen.grabbed.get(told.sequence) : undefined;
        if (grabbed === undefined) return;
        seen.grabbed.delete(told.sequence);
        // The page draws in its own handler of this message; the frame after it shows what was drawn.
        requestAnimationFrame(() => seen.drawn.push([performance.now(), performance.now() - grabbed, told.board]));
      });
    }
  };
})();
