#include "app/cli/CommandParser.h"
#include "app/cli/RenderTraced.h"

namespace patina::cli {

void CommandParser::addLadder() {
    LadderOptions& o = m_ladder;
    CLI::App* c = addCommand(m_app, "ladder",
                             "Every way of lighting in real time against the path tracer: its "
                             "error and its cost",
                             o);
    addSceneAndOutput(c, o, "Numbers: .json; or a sheet of pictures: .png, .jpg, .tif, .tga");
    addEnvironmentOption(c, o);
    c->add_option("--size", o.size, "Pixels of a picture")->capture_default_str()->type_name("WxH");
    c->add_option("--samples", o.paths, "Paths per pixel of the reference, at most")
        ->check(plain(CLI::Range(4, kMostPaths)))
        ->capture_default_str()
        ->type_name("N");
    c->add_option("--noise", o.noise,
                  "The reference ends when the standard error of a pixel is this many percent of "
                  "the picture's mean")
        ->check(plain(CLI::Range(0.001, 100.0)))
        ->type_name("PERCENT");
    c->add_option("--order", o.order, "Bands of the transfer that is baked for it")
        ->check(plain(CLI::Range(1, 8)))
        ->capture_default_str()
        ->type_name("N");
    c->add_option("--rays", o.rays, "Rays per vertex of what is baked for it")
        ->check(plain(CLI::Range(16, 65536)))
        ->capture_default_str()
        ->type_name("N");
    c->add_flag("--blame", o.blame,
                "Says which shortcut of image-based light makes how much of its error");
    c->add_option("--blame-pictures", o.blamePictures,
                  "What each shortcut adds to the picture or lacks, as parts of an .exr")
        ->type_name("FILE");
    addLook(c, o);
    c->add_option("--background", o.background,
                  "visible, blurred, transparent (or off), or a colour as R,G,B or #rrggbb")
        ->type_name("NAME");
    addBakeFiles(c, "--bake", o.bakes, "Bake file to take instead of baking anew (repeatable)");
    addSets(c);
    addThreads(c);
    m_select[c] = [&o] { return decltype(m_invocation.options)(o); };
}

} // namespace patina::cli
