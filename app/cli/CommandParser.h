// The options of every subcommand, as CLI11 wants them told. Seen by the parts of CommandLine only.
#pragma once

#include "app/cli/CommandLine.h"
#include "core/bake/domain/BakePresets.h"

#include <CLI/App.hpp>
#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace patina::cli {

inline constexpr const char* kLayoutNames =
    "lat-long, angular-map, mirror-ball, horizontal-cross, vertical-cross, horizontal-strip, "
    "vertical-strip, six-faces";

struct ListViews {}; // thrown by its flag, as CLI11 throws calls for help

// A check whose bounds the help does not repeat in its own notation; errors still name them. NaN,
// which lies within any of CLI11's ranges, and infinity are refused.
CLI::Validator plain(const CLI::Validator& check);

class CommandParser {
  public:
    CommandParser();
    Result<std::variant<Invocation, HelpText>> parse(int argc, const char* const* argv);

  private:
    // The most specific command that was named.
    CLI::App* innermost();
    std::string innermostName();

    // What several commands have in common (CommandLine.cpp).
    template <class Options>
    CLI::App* addCommand(CLI::App& parent, const char* name, const char* help, Options& options) {
        CLI::App* command = parent.add_subcommand(name, help);
        m_select[command] = [&options] { return decltype(m_invocation.options)(options); };
        addCommon(command);
        return command;
    }
    template <class Options>
    void addScene(CLI::App* command, Options& options) {
        command->add_option("SCENE", options.scene, "Model, .patina project or builtin:NAME")
            ->required()
            ->type_name("");
        addOutside(command);
        addVisualScene(command);
    }
    template <class Options>
    void addSceneAndOutput(CLI::App* command, Options& options, const char* outputHelp) {
        addScene(command, options);
        command->add_option("-o,--output", options.output, outputHelp)
            ->required()
            ->type_name("OUT");
    }
    void addCommon(CLI::App* command);
    void addOutside(CLI::App* command);
    void addVisualScene(CLI::App* command);
    void addThreads(CLI::App* command);
    void addSets(CLI::App* command);
    CLI::Option* addLayout(CLI::App* command, std::string& layout);
    void addBakeFiles(CLI::App* command, const char* name, std::vector<std::string>& bakes,
                      const char* help);

    // BakeCommandLine.cpp
    void addBakes();
    void addBakePrt(CLI::App& bake);
    void addBakeLight(CLI::App& bake);
    void addBakeRadiosity(CLI::App& bake);
    void addBakeIbl(CLI::App& bake);
    void addMerge();
    void addRays(CLI::App* command, int& samples, unsigned& seed, const char* per);
    void addPreset(CLI::App* command, std::function<void(const BakePreset&)> apply);
    void addLongBake(CLI::App* command, LongBakeOptions& options);
    // --shard, --checkpoint, --resume; `prefix`: what the help of the others begins with.
    void addShards(CLI::App* command, LongBakeOptions& options, const char* shardHelp,
                   const char* prefix = "");

    void addRender(); // RenderCommandLine.cpp
    // Of pictures that may be traced, `sheet`'s, too: which renderer, and its options.
    void addTracing(CLI::App* command, TracingOptions& options);
    void addWhitted(CLI::App* command, WhittedOptions& options);

    // SceneCommandLine.cpp
    void addInfo();
    void addSheet();
    void addLadder(); // LadderCommandLine.cpp
    void addRank();
    // What `render` and `sheet` have in common; addLook(): `rank`, too.
    void addLook(CLI::App* command, PictureOptions& options);
    void addEnvironmentOption(CLI::App* command, PictureOptions& options);
    void addPicture(CLI::App* command, PictureOptions& options); // --samples unchecked
    void addEnvironment();
    void addBracket();
    void addExport();
    void addRefine();
    void addCompare();
    void addCertificate(); // CertificateCommandLine.cpp
    void addParameters();

    CLI::App m_app;
    Invocation m_invocation;
    InfoOptions m_info;
    RenderOptions m_render;
    LadderOptions m_ladder;
    SheetOptions m_sheet;
    RankOptions m_rank;
    BakeAoOptions m_ao;
    BakePrtOptions m_prt;
    BakeLightOptions m_light;
    BakeRadiosityOptions m_radiosity;
    BakeIblOptions m_ibl;
    MergeOptions m_merge;
    EnvironmentOptions m_environment;
    BracketCommandOptions m_bracket;
    ExportOptions m_export;
    RefineOptions m_refine;
    CompareOptions m_compare;
    CertificateOptions m_certificate;
    ParametersOptions m_parameters;
    std::map<const CLI::App*, std::function<decltype(m_invocation.options)()>> m_select;
};

} // namespace patina::cli
