// Pictures of a sheet's cells, one after the other, from the document with what they have of their
// own: drawn (SheetDrawn.cpp) or traced (SheetTraced.cpp).
#pragma once

#include "app/cli/Session.h"
#include "app/cli/SheetAxes.h"
#include "core/cells/Cell.h"
#include "core/document/Document.h"
#include "core/sheet/SheetPictures.h"
#include "render/view/FrameSettings.h"

#include <memory>
#include <string>

namespace patina::cli {

struct SceneRequest;

// What they are made of; all but `frame` outlives the cells.
struct SheetSource {
    Session& session;
    const SheetOptions& options;
    Document& document;
    SheetWall& wall;
    const SceneRequest& request;
    render::FrameSettings frame; // floats: pictures are linear
};

class SheetCells {
  public:
    virtual ~SheetCells();
    SheetCells(const SheetCells&) = delete;
    SheetCells& operator=(const SheetCells&) = delete;

    // Before the first one: refuses what cannot be shown.
    virtual Result<void> begin() = 0;
    // Reads the environment's file if it has not been read; nothing where it cannot be and such are
    // skipped.
    Result<void> open(Id environment);
    // Its cells are there: what it took is let go.
    void close(Id environment);
    // The picture, and what there is to say of it. `of`: what the job's activity begins with;
    // `from`, `to`: this cell's part of the progress.
    virtual Result<sheet::DrawnCell> draw(const Cell& cell, const std::string& of, double from,
                                          double to) = 0;

  protected:
    explicit SheetCells(SheetSource source)
        : m_source(std::move(source)) {}
    // The document as the cell shows it, with the camera that it is seen by.
    [[nodiscard]] Result<Document> shownBy(const Cell& cell) const;
    virtual void letGoOfLight() = 0; // of the last environment

    const SheetSource m_source;
};

[[nodiscard]] std::unique_ptr<SheetCells> drawnCells(SheetSource source);
[[nodiscard]] std::unique_ptr<SheetCells> tracedCells(SheetSource source);
// How they are traced, for the sheet's caption: "path traced, 64 paths per pixel". `least`,
// `most`: samples that cells have.
[[nodiscard]] std::string tracingText(const SheetOptions& options, std::uint32_t least,
                                      std::uint32_t most);

} // namespace patina::cli
