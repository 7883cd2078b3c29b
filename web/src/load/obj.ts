// Wavefront OBJ: vertices and faces of any number of corners. Groups, normals, texture coordinates, lines and points
// are read over; what is wrong is named by its line. (three.js' own loader turns it into NaN without a word.)

export class LevelError extends Error {}

class Numbers {
  values: Float64Array | Uint32Array;
  count = 0;

  constructor(private make: (length: number) => Float64Array | Uint32Array) {
    this.values = make(3072);
  }

  push(a: number, b: number, c: number): void {
    if (this.count + 3 > this.values.length) {
      const grown = this.make(2 * this.values.length);
      grown.set(this.values as never);
      this.values = grown;
    }
    this.values[this.count] = a;
    this.values[this.count + 1] = b;
    this.values[this.count + 2] = c;
    this.count += 3;
  }
}

export function readObj(text: string): { positions: Float32Array; indices: Uint32Array } {
  const points = new Numbers((length) => new Float64Array(length));
  const faces = new Numbers((length) => new Uint32Array(length));
  const fail = (line: number, why: string): never => {
    throw new LevelError(`line ${line.toLocaleString('en')}: ${why}`);
  };

  const vertex = (words: string[], line: number): void => {
    const [x, y, z] = [Number(words[1]), Number(words[2]), Number(words[3])];
    if (words.length < 4) fail(line, `a vertex needs three coordinates, here are ${words.length - 1}`);
    if (!Number.isFinite(x) || !Number.isFinite(y) || !Number.isFinite(z)) {
      fail(line, `'${words.slice(1, 4).join(' ')}' is not three finite numbers`);
    }
    points.push(x, y, z);
  };

  const face = (words: string[], line: number): void => {
    if (words.length < 4) fail(line, `a face needs three corners or more, here are ${words.length - 1}`);
    const corners: number[] = [];
    for (let i = 1; i < words.length; i++) {
      const index = Number(words[i]!.split('/', 1)[0]);
      const count = points.count / 3;
      if (!Number.isInteger(index) || index === 0) fail(line, `'${words[i]}' is no vertex: they are counted from 1`);
      const from = index > 0 ? index - 1 : count + index;
      if (from < 0 || from >= count) fail(line, `vertex ${index} is not there: ${count.toLocaleString('en')} come before this line`);
      corners.push(from);
    }
    for (let i = 2; i < corners.length; i++) faces.push(corners[0]!, corners[i - 1]!, corners[i]!);
  };

  let line = 0;
  let pending = '';
  for (let at = 0; at <= text.length;) {
    let end = text.indexOf('\n', at);
    if (end < 0) end = text.length;
    let row = text.slice(at, end);
    at = end + 1;
    line++;
    if (row.endsWith('\r')) row = row.slice(0, -1);
    if (row.endsWith('\\')) {
      pending += row.slice(0, -1) + ' ';
      continue;
    }
    row = pending + row;
    pending = '';
    const head = row.charCodeAt(0);
    if (head !== 118 /* v */ && head !== 102 /* f */ && head !== 32 && head !== 9) continue;
    const comment = row.indexOf('#');
    const words = (comment < 0 ? row : row.slice(0, comment)).trim().split(/\s+/);
    if (words[0] === 'v') vertex(words, line);
    else if (words[0] === 'f') face(words, line);
  }
  if (faces.count === 0) throw new LevelError('holds no faces');
  return {
    positions: Float32Array.from(points.values.subarray(0, points.count) as Float64Array),
    indices: (faces.values as Uint32Array).slice(0, faces.count),
  };
}
