#include "core/export/collada/ColladaTree.h"

#include "core/export/Names.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <system_error>
#include <type_traits>
#include <utility>

namespace patina::collada {
namespace {

// All of the document is kept, white space and comments included, outside of the root element, too
// (parse_fragment); references to characters are resolved, entities of a DTD are not.
constexpr unsigned int kParse = pugi::parse_comments | pugi::parse_pi | pugi::parse_declaration |
                                pugi::parse_doctype | pugi::parse_cdata | pugi::parse_escapes |
                                pugi::parse_ws_pcdata | pugi::parse_fragment;

bool isSpace(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

// Line and column of a place in the text, from 1.
std::string lineAndColumn(std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const auto line = std::ranges::count(before, '\n') + 1;
    const std::size_t start = before.rfind('\n');
    return fmt::format("line {}, column {}", line,
                       before.size() - (start == std::string_view::npos ? 0 : start + 1) + 1);
}

void checkDepth(const pugi::xml_document& document, int most) {
    int depth = 0;
    for (xml_node node = document.first_child(); node;) {
        if (xml_node child = node.first_child(); child) {
            if (++depth > most)
                throw Fault(fmt::format("elements are nested more than {} deep at <{}>; export "
                                        "the scene with a flatter hierarchy",
                                        most, node.name()));
            node = child;
            continue;
        }
        while (node && !node.next_sibling()) {
            node = node.parent();
            --depth;
        }
        if (node)
            node = node.next_sibling();
    }
}

void checkRoot(const pugi::xml_document& document) {
    for (const xml_node& node : document.children())
        if (node.type() == pugi::node_doctype &&
            std::string_view(node.value()).find("<!ENTITY") != std::string_view::npos)
            throw Fault("its DOCTYPE declares entities, which are not read; replace them by what "
                        "they stand for, and delete the DOCTYPE");
    const xml_node root = document.document_element();
    if (!root)
        throw Fault("it is damaged or empty: it has no elements; export it again");
    if (std::string_view(root.name()) != "COLLADA")
        throw Fault(fmt::format("its root element is <{}> instead of <COLLADA>; export it as "
                                "COLLADA 1.4 or 1.5",
                                root.name()));
    for (const xml_node& node : document.children())
        if ((node.type() == pugi::node_element && node != root) ||
            ((node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata) &&
             !trimmed(node.value()).empty()))
            throw Fault(
                "it has more than one root element, or text outside of it; export it again");
    const std::string version = root.attribute("version").value();
    if (!version.starts_with("1.4") && !version.starts_with("1.5"))
        throw Fault(fmt::format("it is COLLADA \"{}\"; export it as COLLADA 1.4 or 1.5", version));
}

// The next word of a list, which it is cut off from.
std::string_view nextWord(std::string_view& list) {
    std::size_t begin = 0;
    while (begin < list.size() && isSpace(list[begin]))
        ++begin;
    std::size_t end = begin;
    while (end < list.size() && !isSpace(list[end]))
        ++end;
    const std::string_view word = list.substr(begin, end - begin);
    list.remove_prefix(end);
    return word;
}

[[noreturn]] void wrongNumber(std::string_view word, const char* kind, xml_node element) {
    throw Fault(fmt::format("\"{}\" in {} is no {}; export the scene again",
                            cleanName(word.substr(0, 40), ""), describe(element), kind));
}

template <class Number>
std::vector<Number> numbersOf(xml_node element) {
    const char* const kind = std::is_integral_v<Number> ? "index" : "finite number";
    const std::string text = textOf(element);
    std::vector<Number> numbers;
    std::string_view rest = text;
    for (std::string_view word = nextWord(rest); !word.empty(); word = nextWord(rest)) {
        std::string_view digits = word;
        if (digits.starts_with('+'))
            digits.remove_prefix(1);
        Number value{};
        const auto [end, error] =
            std::from_chars(digits.data(), digits.data() + digits.size(), value);
        bool good = end == digits.data() + digits.size();
        if constexpr (std::is_floating_point_v<Number>) {
            // Too small for a float is 0; too large is out of range.
            if (good && error == std::errc::result_out_of_range) {
                double wide = 0.0;
                good = std::from_chars(digits.data(), digits.data() + digits.size(), wide).ec ==
                           std::errc() &&
                       std::abs(wide) < 1.0;
                value = Number{0};
            } else {
                good = good && error == std::errc() && std::isfinite(value);
            }
        } else {
            good = good && error == std::errc();
        }
        if (!good)
            wrongNumber(word, kind, element);
        numbers.push_back(value);
    }
    return numbers;
}

} // namespace

Tree::Tree(std::string text, const ColladaLimits& limits)
    : m_limits(limits) {
    const pugi::xml_parse_result parsed = m_document.load_buffer(text.data(), text.size(), kParse);
    if (!parsed)
        throw Fault(fmt::format(
            "it is damaged or cut short at {} ({}); export it again",
            lineAndColumn(text,
                          static_cast<std::size_t>(std::max<std::ptrdiff_t>(parsed.offset, 0))),
            parsed.description()));
    if (parsed.encoding == pugi::encoding_utf8 && text.find('\0') != std::string::npos)
        throw Fault("it holds bytes that are no text; it is damaged or no COLLADA document");
    std::string().swap(text); // pugixml has its own
    checkDepth(m_document, m_limits.depth);
    checkRoot(m_document);
    // What pugixml has converted is written as UTF-8.
    if (xml_node first = m_document.first_child();
        first.type() == pugi::node_declaration && parsed.encoding != pugi::encoding_utf8)
        if (pugi::xml_attribute encoding = first.attribute("encoding"))
            encoding.set_value("utf-8");
    rebuildIds();
}

void Tree::rebuildIds() {
    m_ids.clear();
    for (xml_node node = root(); node; node = nextElement(node, root()))
        if (const char* id = node.attribute("id").value(); *id != '\0')
            m_ids[id].push_back(node);
}

xml_node Tree::find(const std::string& id, std::initializer_list<std::string_view> names) const {
    const auto found = m_ids.find(id);
    if (found == m_ids.end())
        return {};
    xml_node result;
    for (const xml_node& node : found->second) {
        if (std::ranges::find(names, std::string_view(node.name())) == names.end())
            continue;
        if (result)
            throw Fault(fmt::format("two <{}> elements have the id \"{}\"; rename one of them",
                                    node.name(), cleanName(id, "")));
        result = node;
    }
    return result;
}

xml_node Tree::resolve(std::string_view reference, std::initializer_list<std::string_view> names,
                       xml_node from) const {
    if (reference.empty())
        throw Fault(fmt::format("{} refers to no <{}>; export the scene again", describe(from),
                                *names.begin()));
    if (reference.front() != '#')
        throw Fault(fmt::format("{} refers to another file, \"{}\"; export the scene as one file",
                                describe(from), cleanName(reference, "")));
    const std::string id(reference.substr(1));
    if (const xml_node found = find(id, names))
        return found;
    throw Fault(fmt::format("{} refers to a <{}> \"{}\" that is not there; export the scene again",
                            describe(from), *names.begin(), cleanName(id, "")));
}

std::string Tree::newId(std::string_view wanted) {
    // An id is a name of XML: it begins with a letter or underscore.
    std::string base = fileSafeName(wanted, "element");
    if (const char c = base.front(); !((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z')))
        base.insert(0, "_");
    std::string id = base;
    for (int& n = m_nextSuffix[base]; m_ids.contains(id);)
        id = fmt::format("{}-{}", base, ++n + 1);
    m_ids[id]; // taken; its element is added when it is there
    return id;
}

std::string Tree::text() const {
    struct StringWriter final : pugi::xml_writer {
        std::string text;
        void write(const void* data, std::size_t size) override {
            text.append(static_cast<const char*>(data), size);
        }
    } writer;
    m_document.save(writer, "", pugi::format_raw | pugi::format_no_declaration,
                    pugi::encoding_utf8);
    return std::move(writer.text);
}

std::string describe(xml_node element) {
    const auto withId = [](xml_node node) {
        const char* id = node.attribute("id").value();
        if (*id == '\0')
            id = node.attribute("name").value();
        return *id == '\0' ? fmt::format("<{}>", node.name())
                           : fmt::format("<{} id=\"{}\">", node.name(), cleanName(id, ""));
    };
    std::string result = withId(element);
    if (element.attribute("id"))
        return result;
    for (xml_node above = element.parent(); above; above = above.parent())
        if (above.attribute("id"))
            return result + " in " + withId(above);
    return result;
}

std::string textOf(xml_node element) {
    std::string result;
    for (const xml_node& child : element.children())
        if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
            result += child.value();
    return result;
}

std::string trimmed(std::string_view text) {
    while (!text.empty() && isSpace(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && isSpace(text.back()))
        text.remove_suffix(1);
    return std::string(text);
}

std::vector<float> floatsOf(xml_node element) {
    return numbersOf<float>(element);
}

std::vector<double> doublesOf(xml_node element) {
    return numbersOf<double>(element);
}

std::vector<double> doublesOf(xml_node element, std::size_t count) {
    std::vector<double> numbers = numbersOf<double>(element);
    if (numbers.size() != count)
        throw Fault(fmt::format("{} has {} numbers instead of {}; export the scene again",
                                describe(element), numbers.size(), count));
    return numbers;
}

std::vector<std::uint32_t> indicesOf(xml_node element) {
    return numbersOf<std::uint32_t>(element);
}

std::uint64_t countOf(xml_node element, const char* attribute) {
    const std::string text = trimmed(element.attribute(attribute).value());
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
        throw Fault(fmt::format("the {} of {} is \"{}\", which is no count; export the scene again",
                                attribute, describe(element), cleanName(text.substr(0, 40), "")));
    return value;
}

std::uint64_t countOf(xml_node element, const char* attribute, std::uint64_t whereMissing) {
    return element.attribute(attribute) ? countOf(element, attribute) : whereMissing;
}

xml_node nextElement(xml_node element, xml_node top) {
    const auto firstOf = [](xml_node node) {
        while (node && node.type() != pugi::node_element)
            node = node.next_sibling();
        return node;
    };
    if (xml_node child = firstOf(element.first_child()); child)
        return child;
    for (; element && element != top; element = element.parent())
        if (xml_node next = firstOf(element.next_sibling()); next)
            return next;
    return {};
}

} // namespace patina::collada
