#include "render/shader/ShaderLibrary.h"
#include "tests/render/GlTest.h"

#include <epoxy/gl.h>
#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace patina::render {
namespace {

namespace fs = std::filesystem;

// A folder of shaders that goes away with the test.
class ShaderFolder {
  public:
    ShaderFolder()
        : m_path(fs::temp_directory_path() / ("patina-shaders-" + std::to_string(::getpid()))) {
        fs::remove_all(m_path);
        fs::create_directories(m_path / "include");
    }
    ~ShaderFolder() { fs::remove_all(m_path); }
    ShaderFolder(const ShaderFolder&) = delete;
    ShaderFolder& operator=(const ShaderFolder&) = delete;

    // Each write gets a later time than the one before, however fast the test runs.
    void write(const std::string& name, const std::string& text) {
        std::ofstream(m_path / name, std::ios::trunc) << text;
        fs::last_write_time(m_path / name,
                            fs::file_time_type::clock::now() + std::chrono::seconds(++m_writes));
    }
    [[nodiscard]] const fs::path& path() const { return m_path; }

  private:
    fs::path m_path;
    int m_writes = 0;
};

int count(const std::string& text, const std::string& part) {
    int n = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++n;
    return n;
}

Result<std::string> expand(const ShaderFolder& folder, const std::string& name,
                           const std::vector<std::string>& defines = {}) {
    ExpandedShader shader;
    auto done = expandShader(ShaderSources(folder.path()), name, defines, shader);
    if (!done)
        return done.error();
    return shader.text;
}

TEST(ShaderSources, BuiltInFilesAreTheOnesOnDisk) {
    EXPECT_GE(embeddedShaders().size(), 15u);
    for (const char* name : {"surface.frag", "include/frame.glsl", "shared/brdf.glsl"})
        EXPECT_TRUE(ShaderSources().read(name).ok()) << name;
    const auto missing = ShaderSources().read("nothing.frag");
    ASSERT_FALSE(missing.ok());
    EXPECT_NE(missing.error().message.find("nothing.frag"), std::string::npos);
}

TEST(ShaderSources, IncludesAreFoundBesideTheFileAndFromTheRootOnce) {
    ShaderFolder folder;
    folder.write("a.frag", "#version 450 core\n#include \"include/b.glsl\"\n  #  include "
                           "\"include/c.glsl\"\nvoid main() {}\n");
    folder.write("include/b.glsl", "#include \"c.glsl\"\nint b;\n");
    folder.write("include/c.glsl", "int c;\n");
    const auto text = expand(folder, "a.frag", {"FAST", "ORDER 3"});
    ASSERT_TRUE(text.ok()) << text.error().text();
    EXPECT_EQ(count(*text, "int c;"), 1);
    EXPECT_EQ(count(*text, "int b;"), 1);
    EXPECT_EQ(text->find("#version 450 core\n#define FAST\n#define ORDER 3\n#line 2 0\n"), 0u);
    EXPECT_LT(text->find("int c;"), text->find("int b;"));
    EXPECT_EQ(text->find("#include"), std::string::npos);
}

TEST(ShaderSources, CyclesAndMissingIncludesNameTheLine) {
    ShaderFolder folder;
    folder.write("a.frag", "#version 450 core\n\n#include \"include/b.glsl\"\n");
    folder.write("include/b.glsl", "int b;\n#include \"include/c.glsl\"\n");
    folder.write("include/c.glsl", "#include \"b.glsl\"\n");
    const auto cycle = expand(folder, "a.frag");
    ASSERT_FALSE(cycle.ok());
    EXPECT_EQ(cycle.error().kind, ErrorKind::InputBroken);
    EXPECT_EQ(cycle.error().message, "include/c.glsl:1: \"include/b.glsl\" includes itself through "
                                     "a.frag > include/b.glsl > include/c.glsl");

    folder.write("include/b.glsl", "int b;\n\n#include \"gone.glsl\"\n");
    const auto missing = expand(folder, "a.frag");
    ASSERT_FALSE(missing.ok());
    EXPECT_EQ(missing.error().kind, ErrorKind::InputMissing);
    EXPECT_EQ(missing.error().message, "include/b.glsl:3: there is no \"gone.glsl\" to include");
}

TEST(ShaderSources, CompilerLogsOfAllVendorsAreMapped) {
    const std::vector<std::string> files{"a.frag", "include/b.glsl"};
    EXPECT_EQ(mapCompilerLog("0:100012(5): error: `x' undeclared", files),
              "include/b.glsl:12: error: `x' undeclared");
    EXPECT_EQ(mapCompilerLog("0(7) : error C1008: undefined variable \"x\"", files),
              "a.frag:7: error C1008: undefined variable \"x\"");
    EXPECT_EQ(mapCompilerLog("ERROR: 1:100003: 'x' : undeclared identifier", files),
              "include/b.glsl:3: 'x' : undeclared identifier");
    EXPECT_EQ(mapCompilerLog("7:700003: beyond the list\n\nlink failed\n", files),
              "7:700003: beyond the list\nlink failed");
}

using Library = gl::GlTest;

const std::string kVertex = "#version 450 core\nvoid main() { gl_Position = vec4(0.0); }\n";
std::string fragment(const std::string& value) {
    return "#version 450 core\n#include \"include/value.glsl\"\nout vec4 color;\n"
           "void main() {\n    color = vec4(" +
           value + ");\n}\n";
}
const ProgramKey kKey{{"screen.vert", "sky.frag"}, {}};

TEST_F(Library, ProgramsAreCompiledOncePerVariant) {
    ShaderLibrary library(context(), {});
    const auto a = library.program({{"screen.vert", "sky.frag"}, {}});
    const auto again = library.program({{"screen.vert", "sky.frag"}, {}});
    const auto blurred = library.program({{"screen.vert", "sky.frag"}, {"BLURRED"}});
    ASSERT_TRUE(a.ok() && again.ok() && blurred.ok());
    EXPECT_EQ(*a, *again);
    EXPECT_NE((*a)->id(), (*blurred)->id());
    EXPECT_EQ(library.compilations(), 2u);
    EXPECT_TRUE(library.reload().empty());
    EXPECT_EQ(library.compilations(), 2u);
}

// An afternoon of trying things must not fill the driver: what was not drawn with for longest goes.
TEST_F(Library, ProgramsThatWereNotUsedForLongestAreDropped) {
    ShaderLibrary library(context(), {}, 3);
    const auto key = [](int choice) {
        return ProgramKey{{"screen.vert", "sky.frag"}, {"CHOICE " + std::to_string(choice)}};
    };
    const auto get = [&](int choice) {
        const auto program = library.program(key(choice));
        EXPECT_TRUE(program.ok()) << choice;
        return program.ok() ? *program : nullptr;
    };
    const gl::Program* first = get(0);
    const unsigned second = get(1)->id(), third = get(2)->id();
    get(0);
    library.touch(*first);
    EXPECT_EQ(library.drops(), 0u);
    get(3);
    EXPECT_FALSE(glIsProgram(second)); // the first one was asked for since
    EXPECT_TRUE(glIsProgram(third));
    EXPECT_TRUE(glIsProgram(first->id()));
    EXPECT_EQ(library.programCount(), 3u);
    EXPECT_EQ(library.drops(), 1u);
    const std::size_t before = library.compilations();
    get(0);
    get(2);
    get(3);
    EXPECT_EQ(library.compilations(), before);
    get(1); // comes back
    EXPECT_EQ(library.compilations(), before + 1);
    EXPECT_EQ(library.programCount(), 3u);
}

TEST_F(Library, ErrorsNameFileAndLineThroughIncludes) {
    ShaderFolder folder;
    folder.write("screen.vert", kVertex);
    folder.write("mine.frag", fragment("undeclaredValue"));
    folder.write("include/value.glsl", "float value;\n\n\n");
    ShaderLibrary library(context(), folder.path());
    const auto broken = library.program({{"screen.vert", "mine.frag"}, {"A", "B"}});
    ASSERT_FALSE(broken.ok());
    // Drivers differ in what follows.
    EXPECT_EQ(broken.error().detail.find("mine.frag:5: error"), 0u) << broken.error().detail;
    EXPECT_NE(broken.error().detail.find("undeclaredValue"), std::string::npos)
        << broken.error().detail;

    folder.write("sky.frag", fragment("1.0"));
    const auto program = library.program(kKey);
    ASSERT_TRUE(program.ok()) << program.error().text();
    folder.write("sky.frag", fragment("undeclaredValue"));
    auto messages = library.reload();
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_EQ(messages[0].find("sky.frag:5: error"), 0u) << messages[0];

    folder.write("sky.frag", fragment("1.0"));
    folder.write("include/value.glsl", "float value;\n\nfloat other = nothing;\n");
    messages = library.reload();
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_EQ(messages[0].find("include/value.glsl:3: error"), 0u) << messages[0];
}

TEST_F(Library, ReloadCompilesOnlyWhatChangedAndKeepsTheLastGoodProgram) {
    ShaderFolder folder;
    folder.write("screen.vert", kVertex);
    folder.write("sky.frag", fragment("value"));
    folder.write("copy.frag", fragment("0.5"));
    folder.write("include/value.glsl", "const float value = 1.0;\n");
    ShaderLibrary library(context(), folder.path());
    const auto sky = library.program(kKey);
    const auto copy = library.program({{"screen.vert", "copy.frag"}, {}});
    ASSERT_TRUE(sky.ok() && copy.ok());
    const unsigned skyId = (*sky)->id(), copyId = (*copy)->id();
    EXPECT_TRUE(library.reload().empty());
    EXPECT_EQ(library.compilations(), 2u);

    // Broken: the same program goes on, and the fault is told once, not at every poll.
    folder.write("sky.frag", fragment("value +"));
    EXPECT_EQ(library.reload().size(), 1u);
    EXPECT_EQ((*sky)->id(), skyId);
    EXPECT_TRUE(glIsProgram(skyId));
    EXPECT_TRUE(library.reload().empty());

    // Mended: a new program behind the same pointer; the other one was left alone.
    folder.write("sky.frag", fragment("2.0 * value"));
    EXPECT_TRUE(library.reload().empty());
    EXPECT_NE((*sky)->id(), skyId);
    EXPECT_EQ((*copy)->id(), copyId);
    EXPECT_EQ(library.compilations(), 4u);

    // A changed include reaches everyone who has it; a missing one is noticed when it comes back.
    fs::remove(folder.path() / "include" / "value.glsl");
    EXPECT_EQ(library.reload().size(), 2u);
    EXPECT_TRUE(library.reload().empty());
    folder.write("include/value.glsl", "const float value = 3.0;\n");
    EXPECT_TRUE(library.reload().empty());
    EXPECT_EQ(library.compilations(), 8u);
    EXPECT_NE((*copy)->id(), copyId);
}

TEST_F(Library, BrokenFolderFallsBackToTheBuiltInShader) {
    ShaderFolder folder;
    folder.write("screen.vert", kVertex);
    folder.write("copy.frag", "#version 450 core\nbroken\n");
    ShaderLibrary library(context(), folder.path());
    const auto program = library.program({{"screen.vert", "copy.frag"}, {}});
    ASSERT_TRUE(program.ok()) << program.error().text();
    EXPECT_NE((*program)->id(), 0u);
    // And takes the folder's as soon as it compiles.
    const unsigned builtIn = (*program)->id();
    folder.write("copy.frag", "#version 450 core\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n");
    EXPECT_TRUE(library.reload().empty());
    EXPECT_NE((*program)->id(), builtIn);
}

} // namespace
} // namespace patina::render
