extends Node3D

# Bakes the meshes below Level, finds the path around the wall, draws it, and casts a ray into the wall.

func _ready() -> void:
	var faces := PackedVector3Array()
	for child in $Level.get_children():
		if child is MeshInstance3D:
			faces.append_array(child.global_transform * child.mesh.get_faces())

	for node in [$Navmesh, $Soup]:
		var error: String = node.bake(faces)
		if error != "":
			push_error(error)
			return

	var path: PackedVector3Array = $Navmesh.find_path(Vector3(-5, 0, -5), Vector3(5, 0, -5))
	print("path: ", $Navmesh.get_status(), ", ", path.size(), " points")
	draw(path)

	var hit: Dictionary = $Soup.cast_ray(Vector3(-5, 1, 0), Vector3(5, 1, 0))
	print("the ray hits at ", hit.get("position"))


func draw(path: PackedVector3Array) -> void:
	var lines := ImmediateMesh.new()
	lines.surface_begin(Mesh.PRIMITIVE_LINE_STRIP)
	for point in path:
		lines.surface_add_vertex(point + Vector3(0, 0.1, 0))
	lines.surface_end()
	$Path.mesh = lines
