// What a project of a newer Patina holds that this one does not know: kept as text, so that saving
// loses none of it. A value; copies share the text.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace patina {

class UnknownKeys {
  public:
    // Key and value, which is JSON text, in the order of the keys.
    using Entries = std::vector<std::pair<std::string, std::string>>;
    // By the object they stand in: "" (the project), "view", "view.camera", "environment", "model",
    // "bake.KIND", an element's id, or an object in one of these ("12.baseColor.map").
    using ByObject = std::map<std::string, Entries>;

    UnknownKeys() = default;
    explicit UnknownKeys(ByObject byObject)
        : m_byObject(byObject.empty() ? nullptr
                                      : std::make_shared<const ByObject>(std::move(byObject))) {}

    // Null: none.
    [[nodiscard]] const Entries* of(const std::string& object) const {
        if (!m_byObject)
            return nullptr;
        const auto found = m_byObject->find(object);
        return found != m_byObject->end() ? &found->second : nullptr;
    }
    friend bool operator==(const UnknownKeys& a, const UnknownKeys& b) {
        return a.m_byObject == b.m_byObject ||
               (a.m_byObject && b.m_byObject && *a.m_byObject == *b.m_byObject);
    }

  private:
    std::shared_ptr<const ByObject> m_byObject; // null: none
};

} // namespace patina
