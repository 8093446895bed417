#include "core/image/TextRaster.h"

#include "core/base/Check.h"
#include "core/base/Utf8.h"

#include <algorithm>
#include <cmath>
#include <fontconfig/fontconfig.h>
#include <ft2build.h>
#include FT_FREETYPE_H

namespace patina {
namespace {

// The code point at the front of valid UTF-8, which is taken off.
char32_t takeCodePoint(std::string_view& text) {
    const std::size_t length = std::max<std::size_t>(utf8SequenceLength(text), 1);
    const auto byte = [&](std::size_t i) {
        return static_cast<char32_t>(static_cast<unsigned char>(text[i]));
    };
    char32_t point = length == 1 ? byte(0) : byte(0) & (0x7fu >> length);
    for (std::size_t i = 1; i < length; ++i)
        point = point << 6 | (byte(i) & 0x3fu);
    text.remove_prefix(length);
    return point;
}

std::string sansSerifFile() {
    std::string file;
    FcConfig* config = FcInitLoadConfigAndFonts();
    FcPattern* wanted = FcNameParse(reinterpret_cast<const FcChar8*>("sans-serif:regular"));
    FcConfigSubstitute(config, wanted, FcMatchPattern);
    FcDefaultSubstitute(wanted);
    FcResult result = FcResultNoMatch;
    if (FcPattern* found = FcFontMatch(config, wanted, &result)) {
        FcChar8* path = nullptr;
        if (FcPatternGetString(found, FC_FILE, 0, &path) == FcResultMatch)
            file = reinterpret_cast<const char*>(path);
        FcPatternDestroy(found);
    }
    FcPatternDestroy(wanted);
    FcConfigDestroy(config);
    return file;
}

} // namespace

struct TextRaster::Face {
    FT_Library library = nullptr;
    FT_Face face = nullptr;

    Face() = default;
    Face(const Face&) = delete;
    Face& operator=(const Face&) = delete;
    ~Face() {
        if (face)
            FT_Done_Face(face);
        if (library)
            FT_Done_FreeType(library);
    }

    // Calls `put(glyph, pen)` for each rendered character; returns where the pen ends.
    template <class Put>
    int layOut(std::string_view text, int size, bool render, Put put) {
        FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(size));
        int pen = 0;
        while (!text.empty()) {
            const FT_ULong point = takeCodePoint(text);
            if (FT_Load_Char(face, point, render ? FT_LOAD_RENDER : FT_LOAD_DEFAULT) != 0)
                continue;
            put(*face->glyph, pen);
            pen += static_cast<int>(face->glyph->advance.x >> 6);
        }
        return pen;
    }
};

TextRaster::TextRaster(std::unique_ptr<Face> face)
    : m_face(std::move(face)) {}
TextRaster::TextRaster(TextRaster&&) noexcept = default;
TextRaster& TextRaster::operator=(TextRaster&&) noexcept = default;
TextRaster::~TextRaster() = default;

Result<TextRaster> TextRaster::create() {
    auto face = std::make_unique<Face>();
    const std::string file = sansSerifFile();
    if (file.empty() || FT_Init_FreeType(&face->library) != 0 ||
        FT_New_Face(face->library, file.c_str(), 0, &face->face) != 0)
        return Error{ErrorKind::InputMissing,
                     "there is no font to write captions with; install one, for example the "
                     "package fonts-dejavu-core",
                     file,
                     {}};
    return TextRaster(std::move(face));
}

int TextRaster::width(std::string_view text, int size) const {
    const std::string valid = makeValidUtf8(text);
    return m_face->layOut(valid, size, false, [](const FT_GlyphSlotRec&, int) {});
}

void TextRaster::draw(Image& image, int x, int y, int size, const glm::vec3& color,
                      std::string_view text) const {
    CHECK(image.type() == PixelType::U8 && image.channels() >= 3);
    const auto pixels = image.u8();
    const std::string valid = makeValidUtf8(text);
    m_face->layOut(valid, size, true, [&](const FT_GlyphSlotRec& glyph, int pen) {
        const FT_Bitmap& bitmap = glyph.bitmap;
        if (bitmap.pixel_mode != FT_PIXEL_MODE_GRAY)
            return;
        for (int row = 0; row < static_cast<int>(bitmap.rows); ++row)
            for (int column = 0; column < static_cast<int>(bitmap.width); ++column) {
                const int px = x + pen + glyph.bitmap_left + column;
                const int py = y - glyph.bitmap_top + row;
                if (px < 0 || py < 0 || px >= image.width() || py >= image.height())
                    continue;
                const float covered =
                    static_cast<float>(bitmap.buffer[row * bitmap.pitch + column]) / 255.0f;
                const std::size_t at =
                    (static_cast<std::size_t>(py) * static_cast<std::size_t>(image.width()) +
                     static_cast<std::size_t>(px)) *
                    static_cast<std::size_t>(image.channels());
                for (int c = 0; c < 3; ++c) {
                    auto& sample = pixels[at + static_cast<std::size_t>(c)];
                    const float mixed =
                        static_cast<float>(sample) * (1.0f - covered) + 255.0f * color[c] * covered;
                    sample = static_cast<std::uint8_t>(std::lround(mixed));
                }
            }
    });
}

} // namespace patina
