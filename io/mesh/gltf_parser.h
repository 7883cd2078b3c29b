// SPDX-License-Identifier: MIT
//
// cgltf, whose functions get names of ours, so that a program that has its own cgltf links both.

#ifndef TALUS_IO_GLTF_PARSER_H
#define TALUS_IO_GLTF_PARSER_H

#define cgltf_accessor_index          tl_cgltf_accessor_index
#define cgltf_accessor_read_float     tl_cgltf_accessor_read_float
#define cgltf_accessor_read_index     tl_cgltf_accessor_read_index
#define cgltf_accessor_read_uint      tl_cgltf_accessor_read_uint
#define cgltf_accessor_unpack_floats  tl_cgltf_accessor_unpack_floats
#define cgltf_accessor_unpack_indices tl_cgltf_accessor_unpack_indices
#define cgltf_animation_channel_index tl_cgltf_animation_channel_index
#define cgltf_animation_index         tl_cgltf_animation_index
#define cgltf_animation_sampler_index tl_cgltf_animation_sampler_index
#define cgltf_buffer_index            tl_cgltf_buffer_index
#define cgltf_buffer_view_data        tl_cgltf_buffer_view_data
#define cgltf_buffer_view_index       tl_cgltf_buffer_view_index
#define cgltf_calc_size               tl_cgltf_calc_size
#define cgltf_camera_index            tl_cgltf_camera_index
#define cgltf_component_size          tl_cgltf_component_size
#define cgltf_copy_extras_json        tl_cgltf_copy_extras_json
#define cgltf_decode_string           tl_cgltf_decode_string
#define cgltf_decode_uri              tl_cgltf_decode_uri
#define cgltf_find_accessor           tl_cgltf_find_accessor
#define cgltf_free                    tl_cgltf_free
#define cgltf_image_index             tl_cgltf_image_index
#define cgltf_light_index             tl_cgltf_light_index
#define cgltf_load_buffer_base64      tl_cgltf_load_buffer_base64
#define cgltf_load_buffers            tl_cgltf_load_buffers
#define cgltf_material_index          tl_cgltf_material_index
#define cgltf_mesh_index              tl_cgltf_mesh_index
#define cgltf_node_index              tl_cgltf_node_index
#define cgltf_node_transform_local    tl_cgltf_node_transform_local
#define cgltf_node_transform_world    tl_cgltf_node_transform_world
#define cgltf_num_components          tl_cgltf_num_components
#define cgltf_parse                   tl_cgltf_parse
#define cgltf_parse_file              tl_cgltf_parse_file
#define cgltf_sampler_index           tl_cgltf_sampler_index
#define cgltf_scene_index             tl_cgltf_scene_index
#define cgltf_skin_index              tl_cgltf_skin_index
#define cgltf_texture_index           tl_cgltf_texture_index
#define cgltf_validate                tl_cgltf_validate

#include <cgltf.h>

#endif
