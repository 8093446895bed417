#include "core/edit/ComparedValue.h"

#include "core/edit/Edit.h"

#include <fmt/format.h>
#include <string_view>
#include <variant>

namespace patina {

ParameterValue withoutPayload(ParameterValue value) {
    if (auto* slot = std::get_if<MapSlot>(&value)) {
        slot->image = nullptr;
        slot->problem.clear();
    }
    return value;
}

std::string comparedText(const ParameterInfo& info, const ParameterValue& value,
                         const Document& document) {
    if (info.type == ParameterType::Choice) {
        const auto index = static_cast<std::size_t>(std::get<int>(value));
        if (index < info.choiceLabels.size())
            return std::string(info.choiceLabels[index]);
    }
    if (info.type == ParameterType::Bool)
        return std::get<bool>(value) ? "on" : "off";
    if (info.type == ParameterType::Reference) {
        const Id id = static_cast<Id>(std::get<int>(value));
        const std::string name = id == 0 ? "none" : nameOf(document, {info.refersTo, id});
        if (!name.empty())
            return name;
    }
    if (info.type == ParameterType::Map) {
        const std::string& source = std::get<MapSlot>(value).source;
        return source.empty() ? "none" : source;
    }
    return formatParameterValue(info, value);
}

std::string comparedLabel(const ParameterInfo& info, const Document& document, Id element) {
    const std::string_view unit = info.unitFor(document, element);
    return unit.empty() ? std::string(info.label) : fmt::format("{} ({})", info.label, unit);
}

} // namespace patina
