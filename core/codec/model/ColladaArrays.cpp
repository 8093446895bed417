#include "core/codec/model/ColladaArrays.h"

#include "core/codec/Codec.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <pugixml.hpp>
#include <string_view>
#include <unordered_map>

namespace patina::codec {
namespace {

constexpr std::array<std::string_view, 5> kArrays{"float_array", "int_array", "Name_array",
                                                  "IDREF_array", "bool_array"};

// Numbers from the file, which may be as large as they like: stops at the largest.
unsigned long long numbersAskedFor(const pugi::xml_node& accessor) {
    constexpr unsigned long long kAll = std::numeric_limits<unsigned long long>::max();
    const unsigned long long count = accessor.attribute("count").as_ullong();
    if (count == 0)
        return 0;
    const unsigned long long stride = accessor.attribute("stride").as_ullong(1);
    const unsigned long long offset = accessor.attribute("offset").as_ullong();
    const auto params = accessor.children("param");
    const auto used = static_cast<unsigned long long>(std::distance(params.begin(), params.end()));
    const unsigned long long last = std::max(used, std::max(stride, 1ULL));
    if (stride > 0 && count - 1 > (kAll - last) / stride)
        return kAll;
    const unsigned long long all = (count - 1) * stride + last;
    return offset > kAll - all ? kAll : offset + all;
}

class ArrayCheck : public pugi::xml_tree_walker {
  public:
    bool for_each(pugi::xml_node& node) override {
        const std::string_view name = node.name();
        if (std::ranges::find(kArrays, name) != kArrays.end())
            m_counts[node.attribute("id").value()] = node.attribute("count").as_ullong();
        else if (name == "accessor")
            m_accessors.push_back(node);
        return true;
    }

    void finish() const {
        for (const pugi::xml_node& accessor : m_accessors) {
            std::string_view array = accessor.attribute("source").value();
            if (!array.starts_with('#'))
                continue; // of another file, which is not read
            array.remove_prefix(1);
            const auto found = m_counts.find(array);
            if (found == m_counts.end())
                continue; // Assimp says so
            if (const unsigned long long wanted = numbersAskedFor(accessor); wanted > found->second)
                throw Refusal(fmt::format("an <accessor> asks for {} numbers of the array \"{}\", "
                                          "which has {}; export the file again",
                                          wanted, array, found->second));
        }
    }

  private:
    std::unordered_map<std::string_view, unsigned long long> m_counts; // by id
    std::vector<pugi::xml_node> m_accessors;
};

} // namespace

void checkColladaArrays(const pugi::xml_document& document) {
    ArrayCheck check;
    document.root().traverse(check);
    check.finish();
}

} // namespace patina::codec
