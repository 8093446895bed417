// Where there is no OpenGL 4.5, or no display, the editor says so and ends with 69.

#include "core/base/AtomicFile.h"
#include "tests/app/recovery/ChildProcess.h"
#include "tests/support/TemporaryFolder.h"

#include <cstdlib>
#include <gmock/gmock.h>

namespace patina {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class NoOpenGl : public ::testing::Test {
  protected:
    // Starts the editor to draw one frame; its exit status.
    int start(std::map<std::string, std::string> environment) {
        environment["XDG_DATA_HOME"] = folder.path().string();
        environment["XDG_CONFIG_HOME"] = folder.path().string();
        const char* programs = std::getenv("PATINA_BIN_DIR");
        test::ChildProcess editor({std::string(programs ? programs : "bin") + "/patina-editor",
                                   "--quit-after-first-frame"},
                                  environment, (folder / "log").string());
        const int status = editor.wait(120.0);
        const Result<std::string> text = readTextFile(folder / "log", 1 << 20);
        said = text ? *text : std::string();
        return status;
    }
    test::TemporaryFolder folder;
    std::string said;
};

TEST_F(NoOpenGl, WithOpenGlItStarts) {
    EXPECT_EQ(start({}), 0) << said;
}

TEST_F(NoOpenGl, AnOlderOneIsNamedAndRefused) {
    EXPECT_EQ(start({{"MESA_GL_VERSION_OVERRIDE", "3.3"}}), 69) << said;
    EXPECT_THAT(
        said, AllOf(HasSubstr("needs OpenGL 4.5"), HasSubstr("3.3"), HasSubstr("libgl1-mesa-dri")));
}

TEST_F(NoOpenGl, WithoutADriverItSaysWhereToGetOne) {
    EXPECT_EQ(start({{"LIBGL_DRIVERS_PATH", "/nonexistent"}}), 69) << said;
    EXPECT_THAT(said, AllOf(HasSubstr("needs OpenGL 4.5"), HasSubstr("libgl1-mesa-dri")));
}

TEST_F(NoOpenGl, ADriverThatCrashesEndsAnotherProcess) {
    EXPECT_EQ(start({{"LIBGL_DRIVERS_PATH", PATINA_CRASHING_DRIVER}}), 69) << said;
    EXPECT_THAT(said, AllOf(HasSubstr("needs OpenGL 4.5"), HasSubstr("crashes")));
}

TEST_F(NoOpenGl, AWrongDisplayIsNamed) {
    EXPECT_EQ(start({{"DISPLAY", ":4711"}, {"WAYLAND_DISPLAY", ""}}), 69) << said;
    EXPECT_THAT(said, AllOf(HasSubstr("DISPLAY=:4711"), Not(HasSubstr("Aborted"))));
}

TEST_F(NoOpenGl, APlatformWithoutOpenGlIsNamed) {
    EXPECT_EQ(start({{"QT_QPA_PLATFORM", "offscreen"}}), 69) << said;
    EXPECT_THAT(said, HasSubstr("offscreen"));
}

} // namespace
} // namespace patina
