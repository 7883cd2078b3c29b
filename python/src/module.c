// SPDX-License-Identifier: MIT
//
// The extension module talus._talus: the functions of all sources in one table.

#include "world.h"

static PyMethodDef common_methods[] = {
    { "set_error_class", binding_set_error_class, METH_O, NULL },
    { NULL, NULL, 0, NULL },
};

static int fill_module(PyObject *module)
{
    PyMethodDef *const tables[] = {
        common_methods,          binding_soup_methods,        binding_ray_methods,
        binding_hull_methods,    binding_convex_methods,      binding_bake_methods,
        binding_navmesh_methods, binding_edit_methods,        binding_path_methods,
        binding_audit_methods,   binding_pack_methods,        binding_crowd_methods,
        binding_group_methods,   binding_character_methods,   binding_versions_methods,
        binding_world_methods,   binding_world_query_methods, binding_decompose_methods,
    };
    for (size_t i = 0; i < sizeof(tables) / sizeof(tables[0]); i++) {
        if (PyModule_AddFunctions(module, tables[i]) != 0) {
            return -1;
        }
    }
    return PyModule_AddStringConstant(module, "version", tl_version());
}

static PyModuleDef_Slot module_slots[] = {
    { Py_mod_exec, (void *)fill_module },
    { 0, NULL },
};

static PyModuleDef module_def = {
    .m_base = PyModuleDef_HEAD_INIT,
    .m_name = "talus._talus",
    .m_doc = "The C library's functions on buffers; private to the package.",
    .m_size = 0,
    .m_slots = module_slots,
};

PyMODINIT_FUNC PyInit__talus(void)
{
    return PyModuleDef_Init(&module_def);
}
