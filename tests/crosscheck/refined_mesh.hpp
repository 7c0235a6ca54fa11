#pragma once
// Finer meshes of the same shape.

#include "mesh/mesh.hpp"

namespace gneiss::crosscheck {

/// Every sub-triangle becomes a composite with straight sides: sub-triangle s of element e becomes element 4e + s. The
/// shape is the same, curved sides stay the polygons they are. The old nodes keep their numbers, new ones follow. Names
/// of boundaries go to the finer edges and to the new nodes on them; other names of nodes mean the same nodes as
/// before. Regions and data per element are handed down.
/// @param composites  of kind compt
Mesh refined(const Mesh& composites);

}  // namespace gneiss::crosscheck
