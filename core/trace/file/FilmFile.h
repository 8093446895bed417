// A traced picture that is under way as a file: the checkpoint that it goes on from after a crash,
// or the part that one shard of it traced. They hold the film's sums themselves, in double
// precision, which no picture format has: so a picture that was split or resumed ends in the very
// bytes of one that was not. They are read by the program that wrote them.
#pragma once

#include "core/base/Result.h"
#include "core/base/StateFile.h"
#include "core/math/Camera.h"
#include "core/trace/path/Film.h"
#include "core/trace/path/TraceHash.h"
#include "core/trace/path/TraceOutputs.h"
#include "core/trace/path/TraceTiles.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace patina {

// What a film belongs to. Two files go together when all but scene, sets, shard, complete, samples
// and done are equal.
struct FilmManifest {
    int width = 0, height = 0; // pixels
    StateSettings settings;    // what paths depend on besides the scene, by the options' names
    StateSettings display;     // how the picture is shown: parameters of the view by name
    TraceHash inputs;
    Camera camera;
    bool transparent = false;      // the picture has an alpha channel
    bool hasOutputs = false;       // TraceOutputs lie beside the film
    std::string scene;             // what was opened: absolute path or builtin:NAME
    std::vector<std::string> sets; // and the parameters that were set in it: NAME=VALUE
    TraceShard shard;
    bool complete = false;     // every pixel of the shard has all its samples
    std::uint32_t samples = 0; // that every pixel of the shard has
    double done = 0.0;         // share of the shard's samples, 0…1, of the most that it may take
    friend bool operator==(const FilmManifest&, const FilmManifest&) = default;
};

// What makes the two differ, for the user: "--samples (64 there, 128 here)"; nothing when they may
// belong to one picture.
[[nodiscard]] std::optional<std::string> whyDifferent(const FilmManifest& there,
                                                      const FilmManifest& here);

// Writes the pixels of manifest.shard in one step. `outputs`: of the film's size, or empty, as the
// manifest has it. Errors: those of writeFileAtomically().
Result<void> writeFilm(const std::filesystem::path& file, const FilmManifest& manifest,
                       const Film& film, const TraceOutputs& outputs, StateFileName name);

// Whether a file begins as these do.
[[nodiscard]] bool looksLikeFilm(const std::filesystem::path& file);

// Errors: InputMissing; InputBroken for a file that is none, of another version, cut or edited, or
// without the pixels that it speaks of.
Result<FilmManifest> readFilmManifest(const std::filesystem::path& file);

// Puts the pixels of the file's shard into `film` and `outputs`, which have its size or are empty.
// Errors: as above.
Result<FilmManifest> readFilm(const std::filesystem::path& file, Film& film, TraceOutputs& outputs);

} // namespace patina
