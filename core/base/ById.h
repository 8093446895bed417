// Elements by id, for whoever looks many of them up: Document::mesh() and its like search, and a
// search for each of 16,000 parts takes longer than what is done with them.
#pragma once

#include "core/base/Id.h"

#include <functional>
#include <unordered_map>
#include <vector>

namespace patina {

// Points into the vector, which must outlive it unchanged. Of elements that share an id the first
// is found.
template <class Element>
class ById {
  public:
    ById() = default; // of no elements
    // `id`: the member, or function of an element, that says its id.
    template <class IdOf>
    ById(const std::vector<Element>& elements, IdOf id) {
        m_elements.reserve(elements.size());
        for (const Element& element : elements)
            m_elements.try_emplace(std::invoke(id, element), &element);
    }
    explicit ById(const std::vector<Element>& elements)
        : ById(elements, &Element::id) {}

    // Null: there is none.
    [[nodiscard]] const Element* find(Id id) const {
        const auto found = m_elements.find(id);
        return found != m_elements.end() ? found->second : nullptr;
    }
    [[nodiscard]] bool contains(Id id) const { return m_elements.contains(id); }

  private:
    std::unordered_map<Id, const Element*> m_elements;
};

} // namespace patina
