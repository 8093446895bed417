#include "core/codec/image/JpegReader.h"

#include "core/codec/image/PictureAttributes.h"
#include "core/codec/image/RowReader.h"

#include <array>
#include <csetjmp>
#include <cstdio> // jpeglib.h needs it
#include <cstring>
#include <jpeglib.h>

namespace patina::codec {

namespace {

// What libjpeg's callbacks see. It leaves them by longjmp(): nothing here has a destructor.
struct Decoder {
    jpeg_decompress_struct info{};
    jpeg_error_mgr errors{};
    std::jmp_buf failed{};
};

void fail(j_common_ptr info) {
    std::longjmp(static_cast<Decoder*>(info->client_data)->failed, 1);
}

void ignore(j_common_ptr) {} // warnings are counted

bool begin(Decoder& decoder, const unsigned char* data, unsigned long size) {
    if (setjmp(decoder.failed) != 0)
        return false;
    jpeg_create_decompress(&decoder.info);
    jpeg_mem_src(&decoder.info, data, size);
    constexpr unsigned int kWhole = 0xffff;
    for (int marker = 0; marker < 16; ++marker)
        jpeg_save_markers(&decoder.info, JPEG_APP0 + marker, kWhole);
    jpeg_save_markers(&decoder.info, JPEG_COM, kWhole);
    return jpeg_read_header(&decoder.info, FALSE) == JPEG_HEADER_OK;
}

bool start(Decoder& decoder) {
    if (setjmp(decoder.failed) != 0)
        return false;
    return jpeg_start_decompress(&decoder.info) != FALSE;
}

bool readRow(Decoder& decoder, unsigned char* row) {
    if (setjmp(decoder.failed) != 0)
        return false;
    return jpeg_read_scanlines(&decoder.info, &row, 1) == 1;
}

// Which resolution colours have; OpenImageIO names four.
const char* subsamplingOf(const jpeg_decompress_struct& info) {
    const jpeg_component_info* c = info.comp_info;
    if (c[1].h_samp_factor != 1 || c[1].v_samp_factor != 1 || c[2].h_samp_factor != 1 ||
        c[2].v_samp_factor != 1)
        return nullptr;
    struct Known {
        int h, v;
        const char* name;
    };
    for (const Known& known :
         {Known{1, 1, "4:4:4"}, Known{2, 1, "4:2:2"}, Known{2, 2, "4:2:0"}, Known{4, 1, "4:1:1"}})
        if (c[0].h_samp_factor == known.h && c[0].v_samp_factor == known.v)
            return known.name;
    return nullptr;
}

class JpegReader final : public RowReader {
  public:
    JpegReader(std::span<const std::byte> file, bool inspect);
    ~JpegReader() override { jpeg_destroy_decompress(&m_decoder.info); }

  private:
    void nextRow(std::byte* row) override {
        require(readRow(m_decoder, reinterpret_cast<unsigned char*>(row)));
    }
    void describe(bool inspect);
    void require(bool ok) const {
        if (!ok || m_decoder.errors.num_warnings != 0)
            throw HandOn{"libjpeg complains"};
    }

    Decoder m_decoder;
};

JpegReader::JpegReader(std::span<const std::byte> file, bool inspect) {
    m_decoder.info.err = jpeg_std_error(&m_decoder.errors);
    m_decoder.errors.error_exit = fail;
    m_decoder.errors.output_message = ignore;
    m_decoder.info.client_data = &m_decoder;
    require(begin(m_decoder, reinterpret_cast<const unsigned char*>(file.data()), file.size()));
    const J_COLOR_SPACE space = m_decoder.info.jpeg_color_space;
    const int channels = m_decoder.info.num_components;
    if (!(space == JCS_GRAYSCALE && channels == 1) &&
        !((space == JCS_YCbCr || space == JCS_RGB) && channels == 3))
        throw HandOn{"CMYK or unusual channels"};
    require(start(m_decoder));
    describe(inspect);
}

void JpegReader::describe(bool inspect) {
    const jpeg_decompress_struct& info = m_decoder.info;
    m_spec.width = static_cast<int>(info.output_width);
    m_spec.height = static_cast<int>(info.output_height);
    m_spec.fullWidth = m_spec.width;
    m_spec.fullHeight = m_spec.height;
    m_spec.stored = "uint8";
    if (info.num_components == 1)
        m_spec.channelNames = {"Y"};
    else
        m_spec.channelNames = {"R", "G", "B"};

    PictureAttributes attributes;
    if (info.num_components == 3)
        if (const char* subsampling = subsamplingOf(info))
            attributes.set("jpeg:subsampling", subsampling);
    // Exif, XMP, IPTC, and with `inspect` colour profiles: only OpenImageIO takes these apart.
    bool commented = false;
    for (jpeg_saved_marker_ptr marker = info.marker_list; marker != nullptr;
         marker = marker->next) {
        const int which = marker->marker - JPEG_APP0;
        if (which == 1 || which == 13 || (which == 2 && inspect))
            throw HandOn{"metadata"};
        if (marker->marker == JPEG_COM && !commented) {
            commented = true;
            attributes.addText(
                "ImageDescription",
                std::string(reinterpret_cast<const char*>(marker->data), marker->data_length));
        }
    }
    if (info.X_density > 1 && info.Y_density > 1) {
        constexpr std::array kUnits{"none", "in", "cm"};
        if (info.density_unit < kUnits.size())
            attributes.set("ResolutionUnit", kUnits[info.density_unit]);
    }
    m_spec.attributes = attributes.content();
}

} // namespace

std::unique_ptr<PictureReader> readJpeg(std::span<const std::byte> file, bool inspect) {
    return std::make_unique<JpegReader>(file, inspect);
}

} // namespace patina::codec
