// How fast pictures come and how long the way is, from what this page sees of them. No clock: times are given.
const WINDOW_MS = 2000;

export class Pace {
  private judged: number[] = [];
  private readonly sent = new Map<number, number>();
  private trip: number | null = null;

  /** A frame of the kiosk's own camera was sent. */
  send(sequence: number, now: number): void {
    this.sent.set(sequence, now);
  }

  /** The service said what a frame shows; whatever was sent before it is never answered. */
  judge(sequence: number, now: number): void {
    this.judged = [...this.judged.filter((at) => at > now - WINDOW_MS), now];
    const sent = this.sent.get(sequence);
    if (sent !== undefined) this.trip = now - sent;
    for (const number of this.sent.keys()) if (number <= sequence) this.sent.delete(number);
  }

  forget(): void {
    this.judged = [];
    this.sent.clear();
    this.trip = null;
  }

  /** Judged frames in a second; null before there are two. */
  get rate(): number | null {
    const [first, last] = [this.judged[0], this.judged.at(-1)];
    if (first === undefined || last === undefined || last <= first) return null;
    return (1000 * (this.judged.length - 1)) / (last - first);
  }

  /** From sending a frame to its state; null where the service has the camera. */
  get roundTrip(): number | null {
    return this.trip;
  }
}
