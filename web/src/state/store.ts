// A value that tells who listens when it changes.

export class Store<T extends object> {
  private listeners = new Set<(value: Readonly<T>, before: Readonly<T>) => void>();

  constructor(private value: T) {}

  get(): Readonly<T> {
    return this.value;
  }

  set(part: Partial<T>): void {
    const before = this.value;
    const changed = Object.keys(part).some((key) => part[key as keyof T] !== before[key as keyof T]);
    if (!changed) return;
    this.value = { ...before, ...part };
    for (const listener of [...this.listeners]) listener(this.value, before);
  }

  /** Is called at once, and then after every change. Returns what ends it. */
  watch(listener: (value: Readonly<T>, before: Readonly<T>) => void): () => void {
    this.listeners.add(listener);
    listener(this.value, this.value);
    return () => this.listeners.delete(listener);
  }
}
