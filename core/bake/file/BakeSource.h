// What a bake file says so that others can put its values onto the model's own file: for each value
// the node, primitive and vertex it belongs to, and which texels are a surface's own.
#pragma once

#include "core/bake/file/BakeHeader.h"
#include "core/document/Document.h"
#include "core/image/Image.h"

#include <string>
#include <vector>

namespace patina {

struct SourceChannel {
    std::string name;
    std::vector<float> values; // one for each vertex or texel
};

// "source.vertex" and, where they are known, "source.node", "source.mesh", "source.primitive", for
// each vertex; empty when the mesh's file is not known. Numbers are written in digits of base 2048,
// which half floats hold exactly: n = d0 + 2048 · d1 + 2048² · d2, the channels "source.vertex",
// "source.vertex.1", "source.vertex.2"; digits that are 0 everywhere are left out.
[[nodiscard]] std::vector<SourceChannel> sourceChannels(const MeshInstance& mesh);
// How many there are of a mesh, at most.
[[nodiscard]] std::size_t sourceChannelCount(const MeshPtr& mesh);
// The file's name (without its folder), and whether x was negated.
void describeSource(const MeshInstance& mesh, BakeAttributes& attributes);

// "coverage": 1 for the texels that a triangle of the material covers or touches, 0 for those that
// were filled from their neighbours.
[[nodiscard]] SourceChannel coverageChannel(const Document& document, Id material, int side);

// Adds the channels to those of the image, which has at least as many pixels as they have values.
void addChannels(Image& image, const std::vector<SourceChannel>& channels);
// Whether a channel is one of these.
[[nodiscard]] bool isSourceChannel(const std::string& name);

} // namespace patina
