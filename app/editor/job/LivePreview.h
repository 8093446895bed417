// Where a running bake pours its results so that the viewport can show them: written by the pool's
// threads, read by the UI thread.
#pragma once

#include "core/bake/Bake.h"

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

namespace patina::editor {

class LivePreview : public TileSink {
  public:
    explicit LivePreview(BakeKind kind)
        : m_kind(kind) {}

    // By the bake's thread, for it takes its time. Starts as if nothing cast a shadow: ambient
    // visibility 1, or the transfer of an open sky (`prtOrder` bands), so that shadows grow into
    // the picture while the bake converges.
    void begin(const BakeInputs& inputs, int prtOrder, int textureSize);

    void vertices(Id mesh, std::size_t first, int stride, std::span<const float> values) override;
    void texels(Id material, int imageSize, int stride, int x, int y, int width,
                std::span<const float> values) override;
    void passDone(int samples) override;
    void hits(const std::shared_ptr<const HitSource>& hits) override;
    std::optional<BakeView> view() override;

    [[nodiscard]] BakeKind kind() const { return m_kind; }
    [[nodiscard]] int samplesDone() const; // rays per element of the last complete pass
    [[nodiscard]] bool changed() const;    // collect() would hand something over
    void setView(const BakeView& view);    // what is seen comes first, from the next pass on

    // Whether it belongs into the picture; not while a finished bake shows more. The UI thread's.
    [[nodiscard]] bool shown() const { return m_shown; }
    void setShown(bool shown);

    // Of an interreflected bake that keeps them, when it is done; null before.
    [[nodiscard]] std::shared_ptr<const HitSource> bounceHits() const;

    // Hands over everything that changed since the last call; returns whether there was any.
    // The calls happen under the lock: upload and return.
    using VertexSink = std::function<void(Id mesh, int stride, std::span<const float> values)>;
    using TexelSink = std::function<void(Id material, int size, std::span<const float> values)>;
    bool collect(const VertexSink& vertices, const TexelSink& texels);
    void markAllChanged(); // after the OpenGL context was made anew

  private:
    struct Surface {
        int stride = 1;
        std::vector<float> values;
        bool changed = true;
    };
    BakeKind m_kind;
    bool m_shown = true;
    mutable std::mutex m_mutex; // guards what follows
    std::map<Id, Surface> m_vertices, m_texels;
    int m_textureSize = 0, m_samplesDone = 0;
    std::shared_ptr<const HitSource> m_hits;
    std::optional<BakeView> m_view;
};

} // namespace patina::editor
