// Numbers per vertex that bakes made: which ones a mesh instance is drawn with.
#pragma once

#include "core/document/Document.h"
#include "render/gl/Buffer.h"

#include <map>
#include <span>
#include <vector>

namespace patina::render {

// One storage buffer per mesh instance; a live preview hides the attached artifact's values.
class VertexValues {
  public:
    VertexValues(gl::Context& context, BakeKind kind)
        : m_context(context)
        , m_kind(kind) {}

    struct Values {
        gl::Buffer buffer;
        int stride = 0;
        std::size_t count = 0; // vertices
    };

    // Takes over the artifact of the right kind in `document`, uploading what is new.
    void update(const Document& document);
    void preview(Id mesh, int stride, std::span<const float> values);
    void clearPreview() { m_previews.clear(); }

    // Null when there are none, or when they were made for another number of vertices.
    [[nodiscard]] const Values* find(Id mesh, std::size_t vertexCount) const;

  private:
    gl::Context& m_context;
    BakeKind m_kind;
    BakeArtifactPtr m_artifact;
    std::map<Id, Values> m_attached, m_previews;
};

} // namespace patina::render
