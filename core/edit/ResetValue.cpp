#include "core/edit/ResetValue.h"

#include "core/base/Check.h"
#include "core/edit/Edit.h"

namespace patina {

ParameterValue neutralFactor(const ParameterInfo& number) {
    return number.type == ParameterType::Color ? ParameterValue(glm::vec3(1.0f))
                                               : ParameterValue(1.0f);
}

ParameterValue resetValue(const Document& document, const ParameterInfo& info,
                          const Target& target) {
    CHECK(targetExists(document, target));
    const ParameterInfo* map = mapOf(info);
    if (map && std::get<MapSlot>(map->get(document, target.id)).assigned())
        return neutralFactor(info);
    return info.resetTo != nullptr ? info.resetTo(document, target.id) : info.defaultValue();
}

} // namespace patina
