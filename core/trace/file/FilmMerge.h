// The parts that the shards of a traced picture wrote, joined to the film of the whole.
#pragma once

#include "core/trace/file/FilmFile.h"

#include <filesystem>
#include <span>

namespace patina {

struct JoinedFilm {
    FilmManifest manifest; // of the whole picture
    Film film;
    TraceOutputs outputs; // where the parts have them
};

// All parts of a picture, in any order. Errors: those of readFilm(); InputBroken, naming the file,
// for parts of different pictures, the same part twice, an unfinished one; InputMissing when one is
// missing.
Result<JoinedFilm> joinFilms(std::span<const std::filesystem::path> files);

} // namespace patina
