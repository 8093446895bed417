#include "render/GpuHemicubes.h"

#include "core/base/Check.h"
#include "core/material/MapUv.h"
#include "core/material/Material.h"
#include "core/math/Sampling.h"
#include "core/radiosity/FaceItems.h"
#include "core/radiosity/PointFactors.h"
#include "core/trace/BakeSurface.h"
#include "render/gl/Buffer.h"
#include "render/gl/Framebuffer.h"
#include "render/gl/Texture.h"
#include "render/gl/VertexArray.h"
#include "render/shader/ShaderLibrary.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <epoxy/gl.h>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

namespace patina::render {

using radiosity::Face;
using radiosity::FaceItems;
using radiosity::PointFactors;
using radiosity::PointView;

namespace {

constexpr std::uint32_t kCornersOfFace = 4; // of a triangle the last one is not used
// Scene units: nearer than the lift of the eye, so that nothing is cut off that rays would meet.
constexpr float kNearPlane = 1e-6f;

struct HemicubeVertex {
    glm::vec3 position; // scene units
    glm::vec2 uv;       // on the alpha map
};

// Faces in front of which the eye is, or whose backs absorb, of one surface that is not solid
// everywhere (nullptr: of all others).
struct HemicubeBatch {
    const BakeSurface* surface = nullptr;
    bool back = false;
    std::vector<std::uint32_t> indices;
};

// Clip coordinates of a face of the hemicube from the view's, in the order of HemicubeCells: x
// along its rows and y across them; of a side, whose height is half the top's, y = 2 z - 1. z is
// the distance of the near plane, so that depth is its inverse: 1 at the near plane, 0 far away.
std::array<glm::mat4, 5> hemicubeProjections() {
    const auto rows = [](const glm::vec4& x, const glm::vec4& y, const glm::vec4& w) {
        return glm::transpose(glm::mat4(x, y, glm::vec4(0, 0, 0, kNearPlane), w));
    };
    return {rows({1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}),
            rows({0, 1, 0, 0}, {-1, 0, 2, 0}, {1, 0, 0, 0}),
            rows({0, 1, 0, 0}, {1, 0, 2, 0}, {-1, 0, 0, 0}),
            rows({1, 0, 0, 0}, {0, -1, 2, 0}, {0, 1, 0, 0}),
            rows({1, 0, 0, 0}, {0, 1, 2, 0}, {0, -1, 0, 0})};
}

} // namespace

// The thread that the context is current on.
class GpuHemicubes::Thread {
  public:
    Thread()
        : m_thread([this] { serve(); }) {}
    ~Thread() {
        {
            const std::lock_guard lock(m_mutex);
            m_ends = true;
        }
        m_changed.notify_all();
        m_thread.join();
    }
    Thread(const Thread&) = delete;
    Thread& operator=(const Thread&) = delete;

    // Runs `work` there, and returns after it.
    void run(const std::function<void()>& work) {
        std::unique_lock lock(m_mutex);
        bool done = false;
        m_work.emplace_back(&work, &done);
        m_changed.notify_all();
        m_finished.wait(lock, [&] { return done; });
    }
    // Only within run().
    Result<void> open() {
        Result<std::unique_ptr<gl::Context>> context = gl::Context::createHeadless();
        if (!context)
            return context.error();
        m_context = *std::move(context);
        m_shaders.emplace(*m_context, std::filesystem::path());
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_GREATER);
        return {};
    }
    [[nodiscard]] gl::Context& context() { return *m_context; }
    [[nodiscard]] ShaderLibrary& shaders() { return *m_shaders; }

  private:
    void serve() {
        std::unique_lock lock(m_mutex);
        for (;;) {
            m_changed.wait(lock, [&] { return m_ends || !m_work.empty(); });
            if (m_work.empty())
                break;
            const auto [work, done] = m_work.front();
            m_work.pop_front();
            lock.unlock();
            (*work)();
            lock.lock();
            *done = true;
            m_finished.notify_all();
        }
        m_shaders.reset();
        m_context.reset();
    }

    std::mutex m_mutex;
    std::condition_variable m_changed, m_finished;
    std::deque<std::pair<const std::function<void()>*, bool*>> m_work;
    bool m_ends = false;
    std::unique_ptr<gl::Context> m_context;
    std::optional<ShaderLibrary> m_shaders;
    std::thread m_thread; // last: it uses all of the above
};

// What is in OpenGL of a scene. Only on the thread.
struct GpuHemicubes::Scene {
    gl::Buffer vertices, indices;
    gl::VertexArray array;
    gl::Texture items, depth;
    gl::Framebuffer target;
    std::map<const BakeSurface*, gl::Texture> alphas;
};

class GpuHemicubes::Drawn final : public radiosity::DrawnHemicubes {
  public:
    Drawn(std::shared_ptr<Thread> thread, const FaceItems& faces, int resolution)
        : m_thread(std::move(thread))
        , m_faces(faces)
        , m_resolution(resolution) {}
    ~Drawn() override {
        m_thread->run([this] { m_scene.reset(); });
    }
    Drawn(const Drawn&) = delete;
    Drawn& operator=(const Drawn&) = delete;

    Result<void> load() {
        Result<void> result;
        m_thread->run([&] { result = loadThere(); });
        return result;
    }
    void draw(const PointView& view, std::span<std::uint32_t> items) const override {
        const std::vector<HemicubeBatch> batches = batchesOf(view); // on the thread that asks
        m_thread->run([&] { drawThere(view, batches, items); });
    }

  private:
    [[nodiscard]] int height() const { return 3 * m_resolution; }

    Result<void> loadThere() {
        gl::Context& context = m_thread->context();
        if (height() > context.info().maxTextureSize)
            return Error{ErrorKind::Usage,
                         fmt::format("{} draws hemicubes of at most {} cells along an edge; choose "
                                     "a smaller --resolution, or --device cpu",
                                     context.info().renderer,
                                     context.info().maxTextureSize / 6 * 2),
                         {},
                         {}};
        for (const bool alphaTest : {false, true})
            if (const auto shader = program(alphaTest); !shader)
                return shader.error();
        m_scene = std::make_unique<Scene>();
        Scene& scene = *m_scene;
        std::vector<HemicubeVertex> vertices;
        vertices.reserve(kCornersOfFace * m_faces.size());
        for (std::uint32_t f = 0; f < m_faces.size(); ++f) {
            const Face& face = m_faces.face(f);
            const BakeSurface* surface = m_faces.item(f).surface;
            if (surface != nullptr && !scene.alphas.contains(surface))
                scene.alphas.emplace(surface, alphaTexture(context, *surface));
            for (std::size_t k = 0; k < kCornersOfFace; ++k)
                vertices.push_back({glm::vec3(face.corners[k]),
                                    surface != nullptr
                                        ? mapUv(surface->baseColorMap, glm::vec2(face.uvs[k]))
                                        : glm::vec2(0.0f)});
        }
        scene.vertices =
            gl::Buffer::of(context, "hemicube vertices", std::span<const HemicubeVertex>(vertices));
        scene.indices =
            gl::Buffer(context, "hemicube indices", 6 * sizeof(std::uint32_t) * m_faces.size());
        scene.array = gl::VertexArray(context, "hemicube");
        scene.array.setFloats(0, 3, scene.vertices, offsetof(HemicubeVertex, position),
                              sizeof(HemicubeVertex));
        scene.array.setFloats(1, 2, scene.vertices, offsetof(HemicubeVertex, uv),
                              sizeof(HemicubeVertex));
        scene.array.setIndices(scene.indices);
        scene.items = gl::Texture(
            context, "hemicube items",
            {.format = gl::PixelFormat::R32ui, .width = m_resolution, .height = height()});
        scene.depth = gl::Texture(
            context, "hemicube depth",
            {.format = gl::PixelFormat::Depth32f, .width = m_resolution, .height = height()});
        auto target = gl::Framebuffer::create(context, "hemicube", {&scene.items}, &scene.depth);
        if (!target)
            return target.error();
        scene.target = *std::move(target);
        return {};
    }

    // The alpha of the base colour map alone, as Coverage reads it: bilinear, it repeats.
    static gl::Texture alphaTexture(gl::Context& context, const BakeSurface& surface) {
        BakeSurface map;
        map.alphaMode = AlphaMode::Blend;
        map.baseColorMap.image = surface.baseColorMap.image;
        const Coverage coverage(map);
        const bool isMapped = map.baseColorMap.image && !map.baseColorMap.image->empty();
        const int width = isMapped ? map.baseColorMap.image->width() : 1,
                  height = isMapped ? map.baseColorMap.image->height() : 1;
        std::vector<std::uint8_t> alpha;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const glm::vec2 middle((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                                       (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
                alpha.push_back(
                    static_cast<std::uint8_t>(std::lround(255.0f * coverage.alphaAt(middle))));
            }
        gl::Texture texture(context, "hemicube alpha",
                            {.format = gl::PixelFormat::R8, .width = width, .height = height});
        texture.upload(0, 1, gl::SampleType::U8, alpha.data());
        texture.setSampling(gl::Filter::Linear, gl::Wrap::Repeat);
        return texture;
    }

    Result<const gl::Program*> program(bool alphaTest) const {
        return m_thread->shaders().program(
            {{"hemicube.vert", "hemicube.frag"},
             alphaTest ? std::vector<std::string>{"ALPHA_TEST"} : std::vector<std::string>{}});
    }

    // As the paraboloid draws them: no face of the element, and none of two sides from behind.
    [[nodiscard]] std::vector<HemicubeBatch> batchesOf(const PointView& view) const {
        std::vector<HemicubeBatch> batches;
        for (std::uint32_t f = 0; f < m_faces.size(); ++f) {
            const Face& face = m_faces.face(f);
            const FaceItems::Item& item = m_faces.item(f);
            const double distance = view.distanceTo(face);
            const bool back = distance > 0.0;
            if (f == view.ownFace || distance == 0.0 || (back && item.hasOtherSide))
                continue;
            auto batch = std::find_if(batches.begin(), batches.end(), [&](const auto& known) {
                return known.surface == item.surface && known.back == back;
            });
            if (batch == batches.end())
                batch = batches.insert(batch, {item.surface, back, {}});
            const std::uint32_t first = kCornersOfFace * f;
            for (std::uint32_t k = 2; k < face.cornerCount; ++k)
                batch->indices.insert(batch->indices.end(), {first, first + k - 1, first + k});
        }
        return batches;
    }

    void drawThere(const PointView& view, const std::vector<HemicubeBatch>& batches,
                   std::span<std::uint32_t> items) const {
        Scene& scene = *m_scene;
        scene.target.bind();
        scene.target.clearIds(PointFactors::kOutside);
        scene.target.clearDepth(0.0f);
        scene.array.bind();
        std::size_t offset = 0;
        for (const HemicubeBatch& batch : batches) {
            scene.indices.write(offset, std::as_bytes(std::span(batch.indices)));
            offset += batch.indices.size() * sizeof(std::uint32_t);
        }
        const glm::mat4 axes(glm::transpose(glm::mat3(view.frame)));
        std::uint32_t seed = 0x9e3779b9u;
        for (const glm::vec3 eye(view.eye); const float c : {eye.x, eye.y, eye.z})
            seed = hash32(seed ^ std::bit_cast<std::uint32_t>(c));
        static const std::array<glm::mat4, 5> kProjections = hemicubeProjections();
        offset = 0;
        for (const HemicubeBatch& batch : batches) {
            const auto shader = program(batch.surface != nullptr);
            CHECK(shader.ok()); // load() has compiled it
            const gl::Program& used = **shader;
            used.use();
            used.set("u_eye", glm::vec3(view.eye));
            used.set("u_back", batch.back ? 1 : 0);
            if (batch.surface != nullptr) {
                const bool isMask = batch.surface->alphaMode == AlphaMode::Mask;
                scene.alphas.at(batch.surface).bind(0);
                used.set("u_opacity", batch.surface->opacity);
                used.set("u_cutoff", isMask ? batch.surface->alphaCutoff : -1.0f);
                used.set("u_seed", seed);
            }
            int row = 0;
            for (std::size_t face = 0; face < kProjections.size(); ++face) {
                const int rows = face == 0 ? m_resolution : m_resolution / 2;
                glViewport(0, row, m_resolution, rows);
                row += rows;
                used.set("u_viewToClip", kProjections[face] * axes);
                glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(batch.indices.size()),
                               GL_UNSIGNED_INT,
                               reinterpret_cast<const void*>(offset)); // NOLINT: OpenGL's way
            }
            offset += batch.indices.size() * sizeof(std::uint32_t);
        }
        glBindFramebuffer(GL_READ_FRAMEBUFFER, scene.target.id());
        glPixelStorei(GL_PACK_ALIGNMENT, 4);
        glReadPixels(0, 0, m_resolution, height(), GL_RED_INTEGER, GL_UNSIGNED_INT, items.data());
    }

    std::shared_ptr<Thread> m_thread;
    const FaceItems& m_faces;
    int m_resolution;
    std::unique_ptr<Scene> m_scene; // on the thread
};

GpuHemicubes::GpuHemicubes(std::shared_ptr<Thread> thread)
    : m_thread(std::move(thread)) {}
GpuHemicubes::~GpuHemicubes() = default;

Result<std::shared_ptr<GpuHemicubes>> GpuHemicubes::create() {
    auto thread = std::make_shared<Thread>();
    Result<void> opened;
    thread->run([&] { opened = thread->open(); });
    if (!opened)
        return opened.error();
    return std::shared_ptr<GpuHemicubes>(new GpuHemicubes(std::move(thread)));
}

Result<std::unique_ptr<radiosity::DrawnHemicubes>> GpuHemicubes::load(const FaceItems& faces,
                                                                      int resolution) {
    CHECK(resolution % 2 == 0);
    auto drawn = std::make_unique<Drawn>(m_thread, faces, resolution);
    if (const Result<void> loaded = drawn->load(); !loaded)
        return loaded.error();
    return std::unique_ptr<radiosity::DrawnHemicubes>(std::move(drawn));
}

const gl::ContextInfo& GpuHemicubes::info() const {
    return m_thread->context().info();
}

std::string GpuHemicubes::name() const {
    return info().renderer;
}

} // namespace patina::render
