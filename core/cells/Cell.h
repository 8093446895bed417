// One picture of a wall, as what it shows differently from the document.
#pragma once

#include "core/document/Document.h"
#include "core/edit/Parameters.h"
#include "core/job/JobContext.h"

#include <optional>
#include <vector>

namespace patina {

class EditSession;

// A parameter that a cell has of its own.
struct CellEdit {
    Target target; // environment 0: the one that lights the cell
    const ParameterInfo* info = nullptr;
    ParameterValue value;
    friend bool operator==(const CellEdit&, const CellEdit&) = default;
};

// What it does not name is linked: the document's, and changes with it.
struct Cell {
    // One of Document::environments, which lights the cell alone; 0: as the document's mix says.
    Id environment = 0;
    std::vector<CellEdit> own; // in this order
    std::optional<Camera> camera;
    // One of Document::snapshots, whose look the cell shows; what else it has of its own comes on
    // top. 0: none.
    Id snapshot = 0;
    // One of the materials, on all visible meshes; what `own` says of meshes comes on top. 0: each
    // has the document's.
    Id material = 0;
    friend bool operator==(const Cell&, const Cell&) = default;
};

// What either has of its own; where both do, `above` wins.
[[nodiscard]] Cell combined(Cell below, const Cell& above);

// The document as the cell shows it, each parameter set as a user would set it (editsFor()). Meshes
// and images are shared. Pictures of environments are still the document's: see resolveCell().
// Usage error when an element that the cell names is no longer there.
[[nodiscard]] Result<Document> documentOf(const Document& document, const Cell& cell);

// Makes the scene what the cell shows, as one step.
void putIntoScene(EditSession& session, const Cell& cell);

// Generates those pictures of environments and of their mix that documentOf() has made others than
// the document's (a sky with another sun, another cross-fade). They may be missing after a cancel.
void resolveCell(Document& shown, const Document& document, const JobContext& job = {});

} // namespace patina
