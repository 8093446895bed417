#include "core/codec/image/PngReader.h"

#include "core/base/LowerCase.h"
#include "core/codec/image/PictureAttributes.h"
#include "core/codec/image/RowReader.h"

#include <bit>
#include <cstring>
#include <new>
#include <png.h>

namespace patina::codec {

namespace {

// What libpng's callbacks see. It leaves them by longjmp(): nothing here has a destructor that
// matters.
struct Source {
    const std::byte* at = nullptr;
    std::size_t left = 0;
    bool warned = false;
};

void fail(png_structp png, png_const_charp) {
    png_longjmp(png, 1);
}

// OpenImageIO ignores warnings; what exactly it does with such a file is for it to show.
void warn(png_structp png, png_const_charp) {
    static_cast<Source*>(png_get_error_ptr(png))->warned = true;
}

void readBytes(png_structp png, png_bytep target, png_size_t size) {
    auto* source = static_cast<Source*>(png_get_io_ptr(png));
    if (size > source->left)
        png_error(png, "the file ends early");
    std::memcpy(target, source->at, size);
    source->at += size;
    source->left -= size;
}

bool readHeader(png_structp png, png_infop info) {
    if (setjmp(png_jmpbuf(png)) != 0)
        return false;
    png_read_info(png, info);
    png_set_expand(png);
    png_set_interlace_handling(png);
    if (std::endian::native == std::endian::little)
        png_set_swap(png);
    png_read_update_info(png, info);
    return true;
}

bool readRow(png_structp png, std::byte* row) {
    if (setjmp(png_jmpbuf(png)) != 0)
        return false;
    png_read_row(png, reinterpret_cast<png_bytep>(row), nullptr);
    return true;
}

bool readAll(png_structp png, png_bytep* rows) {
    if (setjmp(png_jmpbuf(png)) != 0)
        return false;
    png_read_image(png, rows);
    png_read_end(png, nullptr);
    return true;
}

class PngReader final : public RowReader {
  public:
    PngReader(std::span<const std::byte> file, bool inspect);
    ~PngReader() override { png_destroy_read_struct(&m_png, &m_info, nullptr); }

  private:
    void nextRow(std::byte* row) override;
    void describe(bool inspect);
    void readInterlaced();
    void require(bool ok) const {
        if (!ok || m_source.warned)
            throw HandOn{"libpng complains"};
    }

    Source m_source;
    png_structp m_png = nullptr;
    png_infop m_info = nullptr;
    std::vector<std::byte> m_all; // of an interlaced file, whose rows come in seven passes
    std::size_t m_next = 0;       // row of m_all
};

PngReader::PngReader(std::span<const std::byte> file, bool inspect)
    : m_source{file.data(), file.size()}
    , m_png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &m_source, fail, warn)) {
    if (m_png != nullptr)
        m_info = png_create_info_struct(m_png);
    if (m_info == nullptr)
        throw std::bad_alloc();
    png_set_read_fn(m_png, &m_source, readBytes);
    require(readHeader(m_png, m_info));
    describe(inspect);
}

void PngReader::describe(bool inspect) {
    // Only OpenImageIO takes these apart.
    if (png_get_valid(m_png, m_info, PNG_INFO_eXIf) != 0 ||
        (inspect && png_get_valid(m_png, m_info, PNG_INFO_iCCP) != 0))
        throw HandOn{"metadata"};
    const bool wide = png_get_bit_depth(m_png, m_info) == 16;
    m_spec.x = png_get_x_offset_pixels(m_png, m_info);
    m_spec.y = png_get_y_offset_pixels(m_png, m_info);
    m_spec.width = static_cast<int>(png_get_image_width(m_png, m_info));
    m_spec.height = static_cast<int>(png_get_image_height(m_png, m_info));
    m_spec.fullWidth = m_spec.width;
    m_spec.fullHeight = m_spec.height;
    m_spec.kind = wide ? SampleKind::U16 : SampleKind::U8;
    m_spec.stored = wide ? "uint16" : "uint8";
    static const std::vector<std::string> kNames[] = {
        {"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
    m_spec.channelNames = kNames[png_get_channels(m_png, m_info) - 1];

    PictureAttributes attributes;
    png_textp texts = nullptr;
    const int count = png_get_text(m_png, m_info, &texts, nullptr);
    for (int i = 0; i < count; ++i) {
        const std::string key = texts[i].key;
        const std::string lower = lowerCase(key);
        if (lower == "xml:com.adobe.xmp" || lower == "raw profile type exif")
            throw HandOn{"metadata"};
        attributes.addText(lower == "description" ? "ImageDescription"
                           : lower == "author"    ? "Artist"
                           : lower == "title"     ? "DocumentName"
                                                  : key,
                           texts[i].text);
    }
    png_uint_32 x = 0, y = 0;
    int unit = 0;
    if (png_get_pHYs(m_png, m_info, &x, &y, &unit) != 0)
        attributes.set("ResolutionUnit", unit == PNG_RESOLUTION_METER ? "inch" : "none");
    m_spec.attributes = attributes.content();
}

void PngReader::readInterlaced() {
    const std::size_t stride = png_get_rowbytes(m_png, m_info);
    m_all.resize(stride * static_cast<std::size_t>(m_spec.height));
    std::vector<png_bytep> rows(static_cast<std::size_t>(m_spec.height));
    for (std::size_t i = 0; i < rows.size(); ++i)
        rows[i] = reinterpret_cast<png_bytep>(m_all.data() + i * stride);
    require(readAll(m_png, rows.data()));
}

void PngReader::nextRow(std::byte* row) {
    if (png_get_interlace_type(m_png, m_info) == PNG_INTERLACE_NONE) {
        require(readRow(m_png, row));
        return;
    }
    if (m_all.empty())
        readInterlaced();
    const std::size_t stride = png_get_rowbytes(m_png, m_info);
    std::memcpy(row, m_all.data() + m_next++ * stride, stride);
}

} // namespace

std::unique_ptr<PictureReader> readPng(std::span<const std::byte> file, bool inspect) {
    return std::make_unique<PngReader>(file, inspect);
}

} // namespace patina::codec
