// The command, to compare with: TALUS, or what was built.

import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const built = (path) => fileURLToPath(new URL(`../../build/${path}`, import.meta.url));
export const TALUS = [process.env.TALUS, built('release/cli/talus'), built('cli/talus')].find((path) => path && existsSync(path)) ?? null;
