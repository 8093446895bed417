#include "core/io/PngEncoder.h"

#include "core/base/Check.h"

#include <bit>
#include <cstddef>
#include <memory>
#include <png.h>
#include <string>

namespace patina {
namespace {

// As zlib.h names them.
constexpr int kCompressionLevel = 6;    // the middle of 0…9
constexpr int kCompressionStrategy = 0; // Z_DEFAULT_STRATEGY

struct Writer {
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::string problem;
    Bytes bytes;
    bool noMemory = false;
    ~Writer() { png_destroy_write_struct(&png, &info); }
};

void fail(png_structp png, png_const_charp message) {
    static_cast<Writer*>(png_get_error_ptr(png))->problem = message;
    png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

void append(png_structp png, png_bytep data, png_size_t size) {
    auto* writer = static_cast<Writer*>(png_get_io_ptr(png));
    try {
        const auto* first = reinterpret_cast<const std::byte*>(data);
        writer->bytes.insert(writer->bytes.end(), first, first + size);
    } catch (const std::bad_alloc&) {
        writer->noMemory = true;
    }
    if (writer->noMemory) // outside of the handler: the jump leaves no exception behind
        png_error(png, "out of memory");
}

void flush(png_structp) {}

int colorType(int channels) {
    switch (channels) {
    case 1:
        return PNG_COLOR_TYPE_GRAY;
    case 2:
        return PNG_COLOR_TYPE_GRAY_ALPHA;
    case 3:
        return PNG_COLOR_TYPE_RGB;
    default:
        return PNG_COLOR_TYPE_RGB_ALPHA;
    }
}

// Has only trivial locals: libpng's errors jump out of it.
bool write(Writer& writer, const Image& image) {
    png_structp png = writer.png;
    png_infop info = writer.info;
    if (setjmp(png_jmpbuf(png)) != 0)
        return false;
    const bool wide = image.type() == PixelType::U16;
    const auto height = static_cast<png_uint_32>(image.height());
    png_set_write_fn(png, &writer, append, flush);
    png_set_compression_level(png, kCompressionLevel);
    png_set_compression_strategy(png, kCompressionStrategy);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_NO_FILTERS);
    png_set_IHDR(png, info, static_cast<png_uint_32>(image.width()), height, wide ? 16 : 8,
                 colorType(image.channels()), PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_oFFs(png, info, 0, 0, PNG_OFFSET_PIXEL);
    char key[] = "oiio:ColorSpace", value[] = "sRGB";
    if (image.encoding() == ColorEncoding::Srgb) {
        png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
        png_text text{};
        text.compression = PNG_TEXT_COMPRESSION_NONE;
        text.key = key;
        text.text = value;
        text.text_length = sizeof(value) - 1;
        png_set_text(png, info, &text, 1);
    }
    png_write_info(png, info);
    if (wide && std::endian::native == std::endian::little)
        png_set_swap(png);
    const std::size_t stride = image.bytes().size() / height;
    for (png_uint_32 y = 0; y < height; ++y)
        png_write_row(png, reinterpret_cast<png_const_bytep>(image.bytes().data()) + y * stride);
    png_write_end(png, info);
    return true;
}

} // namespace

Result<Bytes> encodePng(const Image& image) {
    CHECK(!image.empty() && image.type() != PixelType::F32);
    CHECK(image.channels() <= 4);
    Writer writer;
    writer.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writer, fail, ignore);
    if (writer.png != nullptr)
        writer.info = png_create_info_struct(writer.png);
    if (writer.info == nullptr || !write(writer, image))
        return Error{ErrorKind::Internal, "the image cannot be encoded", {}, writer.problem};
    return std::move(writer.bytes);
}

} // namespace patina
