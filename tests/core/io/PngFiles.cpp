#include "tests/core/io/CommonImageFiles.h"

#include <functional>
#include <png.h>
#include <string_view>

namespace patina::test {

namespace {

using PngSetup = std::function<void(png_structp, png_infop)>;

void append(png_structp png, png_bytep data, png_size_t size) {
    auto* bytes = static_cast<Bytes*>(png_get_io_ptr(png));
    const auto* first = reinterpret_cast<const std::byte*>(data);
    bytes->insert(bytes->end(), first, first + size);
}

// 13 x 11 pixels of noise.
Bytes png(int depth, int colorType, bool interlaced, const PngSetup& setup) {
    constexpr png_uint_32 kWidth = 13, kHeight = 11;
    Bytes bytes;
    png_structp writer = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(writer);
    png_set_write_fn(writer, &bytes, append, [](png_structp) {});
    png_set_IHDR(writer, info, kWidth, kHeight, depth, colorType,
                 interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (colorType == PNG_COLOR_TYPE_PALETTE) {
        std::vector<png_color> palette;
        for (int i = 0; i < 1 << depth; ++i)
            palette.push_back({static_cast<png_byte>(7 * i), static_cast<png_byte>(255 - i),
                               static_cast<png_byte>(31 * i)});
        png_set_PLTE(writer, info, palette.data(), static_cast<int>(palette.size()));
    }
    setup(writer, info);
    png_write_info(writer, info);
    std::vector<std::vector<png_byte>> rows(kHeight,
                                            std::vector<png_byte>(png_get_rowbytes(writer, info)));
    std::vector<png_bytep> pointers;
    unsigned int noise = 1;
    for (auto& row : rows) {
        for (png_byte& value : row)
            value = static_cast<png_byte>((noise = noise * 1664525u + 1013904223u) >> 24u);
        pointers.push_back(row.data());
    }
    png_write_image(writer, pointers.data());
    png_write_end(writer, info);
    png_destroy_write_struct(&writer, &info);
    return bytes;
}

void addText(png_structp writer, png_infop info, const char* key, const char* value,
             int compression = PNG_TEXT_COMPRESSION_NONE) {
    std::string keyCopy = key, valueCopy = value, empty;
    png_text text{};
    text.compression = compression;
    text.key = keyCopy.data();
    text.text = valueCopy.data();
    text.text_length = valueCopy.size();
    text.lang = empty.data();
    text.lang_key = empty.data();
    png_set_text(writer, info, &text, 1);
}

} // namespace

std::string emptyProfile() {
    std::string profile(132, '\0');
    const auto put = [&](std::size_t at, std::string_view bytes) {
        profile.replace(at, bytes.size(), bytes);
    };
    put(3, "\x84");
    put(8, "\x02");
    put(12, "mntrRGB XYZ ");
    put(36, "acsp");
    put(68, std::string_view("\0\0\xf6\xd6\0\1\0\0\0\0\xd3\x2d", 12)); // D50
    return profile;
}

SampleFiles pngFiles() {
    SampleFiles files;
    const auto add = [](std::vector<SampleFile>& list, std::string name, Bytes bytes) {
        list.push_back({std::move(name), "png", std::move(bytes)});
    };
    const PngSetup plain = [](png_structp, png_infop) {};

    // Every depth of every kind, interlaced and not, with and without transparency
    const std::vector<std::pair<int, std::vector<int>>> kinds{
        {PNG_COLOR_TYPE_GRAY, {1, 2, 4, 8, 16}},
        {PNG_COLOR_TYPE_GRAY_ALPHA, {8, 16}},
        {PNG_COLOR_TYPE_RGB, {8, 16}},
        {PNG_COLOR_TYPE_RGB_ALPHA, {8, 16}},
        {PNG_COLOR_TYPE_PALETTE, {1, 2, 4, 8}}};
    for (const auto& [kind, depths] : kinds)
        for (const int depth : depths)
            for (const bool interlaced : {false, true})
                for (const bool transparent : {false, true}) {
                    if (transparent && (kind & PNG_COLOR_MASK_ALPHA) != 0)
                        continue;
                    const PngSetup setup = [&, color = kind](png_structp writer, png_infop info) {
                        const png_color_16 value{1, 97, 97, 97, 1};
                        png_byte alphas[2]{0, 128};
                        if (transparent)
                            png_set_tRNS(writer, info, alphas,
                                         color == PNG_COLOR_TYPE_PALETTE ? 2 : 1, &value);
                    };
                    add(files.read,
                        "kind " + std::to_string(kind) + ", " + std::to_string(depth) + " bits" +
                            (interlaced ? ", interlaced" : "") +
                            (transparent ? ", transparent" : ""),
                        png(depth, kind, interlaced, setup));
                }

    // What else a file may say
    const auto rgb = [](const PngSetup& setup) { return png(8, PNG_COLOR_TYPE_RGB, false, setup); };
    const std::pair<const char*, PngSetup> said[] = {
        {"sRGB", [](png_structp w, png_infop i) { png_set_sRGB_gAMA_and_cHRM(w, i, 0); }},
        {"linear", [](png_structp w, png_infop i) { png_set_gAMA(w, i, 1.0); }},
        {"gamma 2.2", [](png_structp w, png_infop i) { png_set_gAMA(w, i, 1 / 2.2); }},
        {"chromaticities",
         [](png_structp w, png_infop i) {
             png_set_cHRM(w, i, .3127, .329, .68, .32, .265, .69, .15, .06);
         }},
        {"dots per metre",
         [](png_structp w, png_infop i) { png_set_pHYs(w, i, 2835, 2835, PNG_RESOLUTION_METER); }},
        {"aspect",
         [](png_structp w, png_infop i) { png_set_pHYs(w, i, 2, 1, PNG_RESOLUTION_UNKNOWN); }},
        {"offset", [](png_structp w, png_infop i) { png_set_oFFs(w, i, 3, -2, PNG_OFFSET_PIXEL); }},
        {"offset 0", [](png_structp w, png_infop i) { png_set_oFFs(w, i, 0, 0, 0); }},
        {"time",
         [](png_structp w, png_infop i) {
             const png_time time{2020, 2, 3, 4, 5, 6};
             png_set_tIME(w, i, &time);
         }},
        {"background",
         [](png_structp w, png_infop i) {
             const png_color_16 color{0, 1, 2, 3, 0};
             png_set_bKGD(w, i, &color);
         }},
        {"texts", [](png_structp w, png_infop i) {
             addText(w, i, "Author", "somebody");
             addText(w, i, "Title", "a title");
             addText(w, i, "Description", "words", PNG_TEXT_COMPRESSION_zTXt);
             addText(w, i, "Software", "a program", PNG_ITXT_COMPRESSION_NONE);
             addText(w, i, "oiio:ColorSpace", "sRGB");
             addText(w, i, "\xe9t\xe9", "\xe0");
         }}};
    for (const auto& [name, setup] : said)
        add(files.read, name, rgb(setup));

    const std::pair<const char*, PngSetup> handedOn[] = {
        {"XMP", [](png_structp w, png_infop i) { addText(w, i, "XML:com.adobe.xmp", "<x/>", 1); }},
        {"Exif as text",
         [](png_structp w, png_infop i) { addText(w, i, "Raw profile type exif", "exif 0"); }},
        {"two texts of one name",
         [](png_structp w, png_infop i) {
             addText(w, i, "Comment", "one");
             addText(w, i, "comment", "two");
         }},
        {"colour profile",
         [](png_structp w, png_infop i) {
             const std::string profile = emptyProfile();
             png_set_iCCP(w, i, "profile", 0, reinterpret_cast<png_const_bytep>(profile.data()),
                          static_cast<png_uint_32>(profile.size()));
         }},
        {"exposure", [](png_structp w, png_infop i) { addText(w, i, "exposuretime", "0.5"); }},
        {"Exif", [](png_structp w, png_infop i) {
             png_byte exif[] = {'I', 'I', 42, 0, 8, 0, 0, 0, 0, 0, 0, 0, 0, 0};
             png_set_eXIf_1(w, i, sizeof exif, exif);
         }}};
    for (const auto& [name, setup] : handedOn)
        add(files.handedOn, name, rgb(setup));
    return files;
}

} // namespace patina::test
