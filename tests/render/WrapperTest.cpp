#include "render/gl/Buffer.h"
#include "render/gl/Framebuffer.h"
#include "render/gl/Program.h"
#include "render/gl/Texture.h"
#include "render/gl/VertexArray.h"
#include "tests/render/GlTest.h"

#include <cstring>
#include <epoxy/gl.h>
#include <numeric>
#include <type_traits>

namespace patina::gl {
namespace {

template <class T>
constexpr bool kMoveOnly =
    std::is_nothrow_move_constructible_v<T>&& std::is_nothrow_move_assignable_v<T> &&
    !std::is_copy_constructible_v<T>;
static_assert(kMoveOnly<Buffer> && kMoveOnly<Texture> && kMoveOnly<Framebuffer>);
static_assert(kMoveOnly<Program> && kMoveOnly<VertexArray>);

TEST(EmptyWrappers, NeedNoContextAndAreZero) {
    Buffer buffer;
    Texture texture;
    Framebuffer framebuffer;
    Program program;
    VertexArray vertexArray;
    EXPECT_EQ(buffer.id() + texture.id() + framebuffer.id() + program.id() + vertexArray.id(), 0u);
    Buffer moved = std::move(buffer);
    EXPECT_TRUE(moved.empty());
    EXPECT_TRUE(moved.read().empty());
}

TEST(ContextWithoutOne, AdoptSaysThatNoneIsCurrent) {
    const auto adopted = Context::adoptCurrent();
    ASSERT_FALSE(adopted.ok());
    EXPECT_EQ(adopted.error().kind, ErrorKind::NoOpenGl);
}

class Wrappers : public GlTest {};

std::string labelOf(GLenum kind, GLuint id) {
    char text[64] = {};
    GLsizei length = 0;
    glGetObjectLabel(kind, id, sizeof text, &length, text);
    return {text, static_cast<std::size_t>(length)};
}

TEST_F(Wrappers, ContextDescribesItselfAndCanBeAdopted) {
    EXPECT_GE(context().info().maxTextureSize, 4096);
    EXPECT_GE(context().info().maxSamples, 4);
    EXPECT_FALSE(context().info().renderer.empty());
    const auto adopted = Context::adoptCurrent();
    ASSERT_TRUE(adopted.ok()) << adopted.error().text();
    EXPECT_EQ((*adopted)->info().version, context().info().version);
}

TEST_F(Wrappers, BufferKeepsWhatWasWritten) {
    std::vector<float> values(100);
    std::iota(values.begin(), values.end(), 0.0f);
    Buffer buffer = Buffer::of<float>(context(), "numbers", values);
    EXPECT_EQ(labelOf(GL_BUFFER, buffer.id()), "numbers");
    const float seven = -7.0f;
    buffer.write(7 * sizeof(float), std::as_bytes(std::span(&seven, 1)));
    values[7] = seven;
    const auto bytes = buffer.read();
    ASSERT_EQ(bytes.size(), values.size() * sizeof(float));
    EXPECT_EQ(std::memcmp(bytes.data(), values.data(), bytes.size()), 0);

    const Buffer zeros(context(), "zeros", std::size_t{64});
    for (const std::byte b : zeros.read())
        EXPECT_EQ(b, std::byte{0});
}

TEST_F(Wrappers, MovingTransfersTheNameAndDeletesTheOldOne) {
    Buffer first(context(), "first", std::size_t{16});
    Buffer second(context(), "second", std::size_t{16});
    const unsigned firstId = first.id(), secondId = second.id();
    second = std::move(first);
    EXPECT_EQ(second.id(), firstId);
    EXPECT_TRUE(first.empty()); // NOLINT: looking at the moved-from state is the point
    EXPECT_FALSE(glIsBuffer(secondId));
    EXPECT_TRUE(glIsBuffer(firstId));
    {
        const Buffer last = std::move(second);
        EXPECT_TRUE(glIsBuffer(firstId));
    }
    EXPECT_FALSE(glIsBuffer(firstId));
}

TEST_F(Wrappers, TextureDecodesSrgbAndSwizzles) {
    // sRGB 188 is linear 0.5029 (IEC 61966-2-1).
    const std::uint8_t pixel[3] = {188, 0, 255};
    Texture texture(context(), "pixel",
                    {.format = PixelFormat::Srgb8Alpha8, .width = 1, .height = 1});
    texture.upload(0, 3, SampleType::U8, pixel);
    const auto stored = texture.readFloats(4);
    EXPECT_NEAR(stored[0], 188.0f / 255.0f, 1e-6f); // glGetTexImage does not decode
    EXPECT_FLOAT_EQ(stored[3], 1.0f);

    Texture full(context(), "chain", {.width = 300, .height = 17, .levels = 0});
    EXPECT_EQ(full.levels(), 9); // 300 150 75 37 18 9 4 2 1
    EXPECT_EQ(labelOf(GL_TEXTURE, full.id()), "chain");
}

TEST_F(Wrappers, MultisampleFramebufferResolvesColorAndDepth) {
    for (const int samples : {1, 2, 4}) {
        const TextureKind kind = samples > 1 ? TextureKind::Multisample : TextureKind::Flat;
        const Texture color(context(), "color",
                            {.kind = kind,
                             .format = PixelFormat::Rgba16f,
                             .width = 8,
                             .height = 4,
                             .samples = samples});
        const Texture depth(context(), "depth",
                            {.kind = kind,
                             .format = PixelFormat::Depth32f,
                             .width = 8,
                             .height = 4,
                             .samples = samples});
        const Texture flat(context(), "flat",
                           {.format = PixelFormat::Rgba16f, .width = 8, .height = 4});
        const Texture flatDepth(context(), "flat depth",
                                {.format = PixelFormat::Depth32f, .width = 8, .height = 4});
        auto source = Framebuffer::create(context(), "source", {&color}, &depth);
        auto target = Framebuffer::create(context(), "target", {&flat}, &flatDepth);
        ASSERT_TRUE(source.ok() && target.ok());
        source->clearColor(0.25f, 2.0f, 100.0f, 0.5f);
        source->clearDepth(0.75f);
        source->resolveTo(*target, true);
        const auto values = flat.readFloats(4);
        for (std::size_t i = 0; i < values.size(); i += 4) {
            EXPECT_EQ(values[i], 0.25f);
            EXPECT_EQ(values[i + 2], 100.0f);
        }
        for (const float d : flatDepth.readFloats(1))
            EXPECT_FLOAT_EQ(d, 0.75f);
    }
}

TEST_F(Wrappers, FramebufferWithMixedSampleCountsIsRefused) {
    const Texture color(context(), "color",
                        {.kind = TextureKind::Multisample, .width = 8, .height = 8, .samples = 4});
    const Texture depth(context(), "depth",
                        {.format = PixelFormat::Depth32f, .width = 8, .height = 8});
    const auto mixed = Framebuffer::create(context(), "mixed", {&color}, &depth);
    ASSERT_FALSE(mixed.ok());
    EXPECT_NE(mixed.error().detail.find("mixed"), std::string::npos);
}

TEST_F(Wrappers, ProgramDrawsWithVertexArrayAndUniforms) {
    const StageSource stages[] = {
        {Stage::Vertex, "#version 450 core\nlayout(location = 2) in vec2 p;\n"
                        "void main() { gl_Position = vec4(p, 0, 1); }\n"},
        {Stage::Fragment, "#version 450 core\nuniform vec4 u_color; out vec4 color;\n"
                          "void main() { color = u_color; }\n"}};
    const auto program = Program::create(context(), "flat", stages);
    ASSERT_TRUE(program.ok()) << program.error().text();
    EXPECT_EQ(labelOf(GL_PROGRAM, program->id()), "flat");

    const float corners[] = {-1, -1, 3, -1, -1, 3};
    const std::uint32_t order[] = {0, 1, 2};
    const Buffer vertices = Buffer::of<float>(context(), "corners", corners);
    const Buffer indices = Buffer::of<std::uint32_t>(context(), "order", order);
    VertexArray array(context(), "triangle");
    array.setFloats(2, 2, vertices, 0, 8);
    array.setIndices(indices);

    const Texture color(context(), "target",
                        {.format = PixelFormat::Rgba32f, .width = 4, .height = 4});
    const auto target = Framebuffer::create(context(), "target", {&color}, nullptr);
    ASSERT_TRUE(target.ok());
    target->bind();
    program->use();
    program->set("u_color", glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    program->set("u_unused", 3.0f); // ignored
    array.bind();
    glDrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_INT, nullptr);
    const auto values = color.readFloats(4);
    for (std::size_t i = 0; i < values.size(); i += 4) {
        EXPECT_FLOAT_EQ(values[i], 0.1f);
        EXPECT_FLOAT_EQ(values[i + 3], 0.4f);
    }
}

TEST_F(Wrappers, ProgramErrorsCarryTheCompilersLog) {
    const StageSource broken[] = {{Stage::Compute, "#version 450 core\nlayout(local_size_x = 1) in;"
                                                   "\nvoid main() { nonsense(); }\n"}};
    const auto program = Program::create(context(), "broken", broken);
    ASSERT_FALSE(program.ok());
    EXPECT_NE(program.error().detail.find("nonsense"), std::string::npos);
    EXPECT_NE(program.error().message.find("broken"), std::string::npos);

    const StageSource unlinkable[] = {{Stage::Fragment,
                                       "#version 450 core\nvec4 elsewhere(); out vec4 c;\n"
                                       "void main() { c = elsewhere(); }\n"}};
    EXPECT_FALSE(Program::create(context(), "unlinkable", unlinkable).ok());
}

TEST(HeadlessContext, ComesAndGoesCleanly) {
    for (int i = 0; i < 3; ++i) {
        const auto context = Context::createHeadless();
        ASSERT_TRUE(context.ok()) << context.error().text();
        const Buffer buffer(**context, "b", std::size_t{4});
        EXPECT_TRUE(glIsBuffer(buffer.id()));
    }
    EXPECT_FALSE(Context::adoptCurrent().ok());
}

TEST(HeadlessContext, OnlyTheRendererThatIsNamedWillDo) {
    std::string name;
    {
        const auto any = Context::createHeadless();
        ASSERT_TRUE(any.ok()) << any.error().text();
        name = any.value()->info().renderer;
    }
    {
        const auto named = Context::createHeadless(name);
        ASSERT_TRUE(named.ok()) << named.error().text();
        EXPECT_EQ(named.value()->info().renderer, name);
    }
    const auto other = Context::createHeadless("no such renderer");
    ASSERT_FALSE(other.ok());
    EXPECT_NE(other.error().detail.find(name), std::string::npos) << other.error().detail;
    EXPECT_FALSE(Context::adoptCurrent().ok()) << "none is left current";
}

} // namespace
} // namespace patina::gl
