// The parts of the package `talus` that the engine uses. The package's own worker is left out, for the engine is one
// itself; the types are those of the whole package.

export { init, threads } from '../../../js/src/module.js';
export { TalusError } from '../../../js/src/error.js';
export { Mesh, sampleLevel, sampleLevels } from '../../../js/src/mesh.js';
export { Soup } from '../../../js/src/soup.js';
export { Hull } from '../../../js/src/hull.js';
export { tileGrid } from '../../../js/src/nav_options.js';
export { bakeStages, polygonSteps } from '../../../js/src/stages.js';
export { Navmesh } from '../../../js/src/navmesh.js';
import '../../../js/src/nav_query.js';
import '../../../js/src/nav_change.js';
export { jumpLinkPoint } from '../../../js/src/nav_tools.js';
export { loadPack, savePack } from '../../../js/src/pack.js';
