// What a file says beside its pixels, in the names of OpenImageIO 2.4, for the readers that do
// without it.
#pragma once

#include "core/codec/image/PictureReader.h"

#include <map>
#include <set>
#include <string>

namespace patina::codec {

// Names differ by more than case for OpenImageIO, and some have a meaning of their own: whatever
// depends on that is handed on (HandOn).
class PictureAttributes {
  public:
    void addText(const std::string& name, const std::string& text);
    void addNumber(const std::string& name, float value);
    // Of any other type: no content, but the name is taken.
    void addOther(const std::string& name);
    // Those that a reader adds itself, as OpenImageIO's does.
    void set(const std::string& name, std::string text) { m_content[name] = std::move(text); }

    [[nodiscard]] std::map<std::string, std::string> content() const { return m_content; }

  private:
    void claim(const std::string& name);

    std::map<std::string, std::string> m_content;
    std::set<std::string> m_taken; // in lower case
};

} // namespace patina::codec
