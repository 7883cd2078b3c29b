// SPDX-License-Identifier: MIT

/** Runs what must throw a TalusError, and gives it. */
export function errorOf(run) {
  try {
    run();
  } catch (error) {
    if (error.name !== 'TalusError') throw error;
    return error;
  }
  throw new Error('nothing was thrown');
}
