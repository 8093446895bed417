// A step of an edited document's history: it stores ids and values, never pointers into the
// document, and swaps between what was and what is. EditSteps.h has those there are.
#pragma once

#include "core/edit/Change.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace patina {

struct Document;

// Edits of the same parameters that carry the same session merge into one step; 0 never merges.
using DragSession = std::uint64_t;

class EditStep {
  public:
    explicit EditStep(std::string text)
        : m_text(std::move(text)) {}
    virtual ~EditStep() = default;
    EditStep(const EditStep&) = delete;
    EditStep& operator=(const EditStep&) = delete;

    [[nodiscard]] const std::string& text() const { return m_text; } // "Change Roughness of Gold"
    // Its values before and after, "0.3 → 0.9", where it is about one number, colour or choice;
    // else empty.
    [[nodiscard]] virtual std::string values() const { return {}; }
    // Makes the edit, or takes it back.
    virtual Change swap(Document& document, bool forward) = 0;
    // Makes `next`, which was done right after this one, a part of it; false: they stay two.
    virtual bool merge(const EditStep& /*next*/) { return false; }
    // Both sides are equal.
    [[nodiscard]] virtual bool isEmpty() const { return false; }
    // Memory that only this step keeps alive, roughly: images, meshes, bakes.
    [[nodiscard]] virtual std::size_t payloadBytes() const { return 0; }

  private:
    friend class EditSession;
    std::string m_text;
    std::uint64_t m_mergeMark = 0;
    // DocumentState::step on its two sides; the second is 0 while it was not done yet.
    std::uint64_t m_stateBefore = 0, m_stateAfter = 0;
};

} // namespace patina
