// Of questions that come faster than answers, such as those of a drag, the last one counts: one is under way, one
// waits, and those between are dropped.

export class Latest {
  private running = false;
  private waiting: (() => Promise<void>) | null = null;

  run(work: () => Promise<void>): void {
    this.waiting = work;
    if (!this.running) void this.drain();
  }

  get idle(): boolean {
    return !this.running;
  }

  private async drain(): Promise<void> {
    this.running = true;
    while (this.waiting) {
      const work = this.waiting;
      this.waiting = null;
      try {
        await work();
      } catch {
        // The work reports its own failures.
      }
    }
    this.running = false;
  }
}
