// Growing arrays of triangles and lines with a colour each, relative to an anchor.

import type { LineData, TriangleData, Vec3 } from '../protocol';

class Soup {
  positions: Float32Array;
  colours: Uint8Array;
  used = 0; // numbers

  constructor(private anchor: Vec3, points: number) {
    this.positions = new Float32Array(3 * points);
    this.colours = new Uint8Array(3 * points);
  }

  add(source: ArrayLike<number>, at: number, colour: number, lift: number): void {
    if (this.used + 3 > this.positions.length) this.grow();
    const { positions, colours, used, anchor } = this;
    positions[used] = source[at]! - anchor[0];
    positions[used + 1] = source[at + 1]! - anchor[1] + lift;
    positions[used + 2] = source[at + 2]! - anchor[2];
    colours[used] = colour >> 16;
    colours[used + 1] = (colour >> 8) & 255;
    colours[used + 2] = colour & 255;
    this.used = used + 3;
  }

  private grow(): void {
    const positions = new Float32Array(Math.max(3072, 2 * this.positions.length));
    const colours = new Uint8Array(positions.length);
    positions.set(this.positions);
    colours.set(this.colours);
    this.positions = positions;
    this.colours = colours;
  }

  take(): { positions: Float32Array; colours: Uint8Array } {
    return { positions: this.positions.slice(0, this.used), colours: this.colours.slice(0, this.used) };
  }
}

export class Writer {
  private faces: Soup;
  private segments: Soup;

  /** `lift`: metres by which all is raised. */
  constructor(readonly anchor: Vec3, public lift = 0, triangles = 0, lines = 0) {
    this.faces = new Soup(anchor, 3 * triangles);
    this.segments = new Soup(anchor, 2 * lines);
  }

  /** a, b, c: where in `source` the corners begin. */
  triangle(source: ArrayLike<number>, a: number, b: number, c: number, colour: number): void {
    this.faces.add(source, a, colour, this.lift);
    this.faces.add(source, b, colour, this.lift);
    this.faces.add(source, c, colour, this.lift);
  }

  line(source: ArrayLike<number>, a: number, b: number, colour: number, lift = this.lift): void {
    this.segments.add(source, a, colour, lift);
    this.segments.add(source, b, colour, lift);
  }

  /** The twelve edges of a box: min x, y, z, max x, y, z at `at`. */
  box(boxes: ArrayLike<number>, at: number, colour: number): void {
    const corner = (i: number): [number, number, number] =>
      [boxes[at + (i & 1 ? 3 : 0)]!, boxes[at + (i & 2 ? 4 : 1)]!, boxes[at + (i & 4 ? 5 : 2)]!];
    for (let i = 0; i < 8; i++) {
      for (const bit of [1, 2, 4]) {
        if ((i & bit) === 0) this.line([...corner(i), ...corner(i | bit)], 0, 3, colour);
      }
    }
  }

  triangles(): TriangleData {
    return this.faces.take();
  }

  lines(): LineData {
    return this.segments.take();
  }
}
