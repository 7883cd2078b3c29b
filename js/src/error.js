// SPDX-License-Identifier: MIT

export class TalusError extends Error {
  constructor(result, message, report = {}) {
    super(message);
    this.name = 'TalusError';
    this.result = result;
    this.stage = report.stage ?? null;
    this.field = report.field ?? null;
    this.element = report.element ?? null;
    this.elementIndex = report.elementIndex >= 0 ? report.elementIndex : null;
    this.advice = report.advice ?? null;
  }
}

/** agent_radius -> agentRadius */
export function camelCase(name) {
  return name.replace(/_([a-z])/g, (_, letter) => letter.toUpperCase());
}

/** One sentence of all that the library's report says, its names spelled as in JavaScript. */
export function resultError(name, text, report) {
  const field = report.field === null ? null : camelCase(report.field);
  const advice = report.advice?.replace(/\b(?!tl_)[a-z]+(_[a-z]+)+\b/g, camelCase) ?? null;
  let message = name === null ? text : `${text} (${name})`;
  if (report.stage) message += `, stage ${report.stage}`;
  if (field) message += `, ${field}`;
  if (report.element) message += `, ${report.element}${report.elementIndex >= 0 ? ` ${report.elementIndex}` : ''}`;
  if (advice) message += `: ${advice}`;
  return new TalusError(name, message, { ...report, field, advice });
}

/** The value, or an error where it is no whole number between two. */
export function wholeNumber(name, value, least = 0, most = 0xffffffff) {
  if (Number.isInteger(value) && value >= least && value <= most) return value;
  throw argumentError(name, most === 0xffffffff ? `give a whole number >= ${least}` : `give a whole number from ${least} to ${most}`);
}

export function argumentError(field, advice) {
  return new TalusError('TL_ERR_ARGUMENT', `an argument is wrong (TL_ERR_ARGUMENT), ${field}: ${advice}`, { field, advice });
}
