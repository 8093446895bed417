#include "tests/core/io/CommonImageFiles.h"

#include <array>
#include <cstdio> // jpeglib.h needs it
#include <cstdlib>
#include <functional>
#include <jpeglib.h>

namespace patina::test {

namespace {

using JpegSetup = std::function<void(jpeg_compress_struct&)>;
using JpegMarkers = std::function<void(jpeg_compress_struct&)>;

// 37 x 21 pixels of a gradient with noise.
Bytes jpeg(J_COLOR_SPACE space, int channels, const JpegSetup& setup,
           const JpegMarkers& markers = {}) {
    constexpr int kWidth = 37, kHeight = 21;
    jpeg_compress_struct info{};
    jpeg_error_mgr errors{};
    info.err = jpeg_std_error(&errors);
    jpeg_create_compress(&info);
    unsigned char* data = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&info, &data, &size);
    info.image_width = kWidth;
    info.image_height = kHeight;
    info.input_components = channels;
    info.in_color_space = space;
    jpeg_set_defaults(&info);
    setup(info);
    jpeg_start_compress(&info, TRUE);
    if (markers)
        markers(info);
    unsigned int noise = 1;
    std::vector<unsigned char> row(static_cast<std::size_t>(kWidth * channels));
    for (int y = 0; y < kHeight; ++y) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            noise = noise * 1664525u + 1013904223u;
            row[i] = static_cast<unsigned char>(2 * i + static_cast<std::size_t>(5 * y) +
                                                (noise >> 28u));
        }
        JSAMPROW pointer = row.data();
        jpeg_write_scanlines(&info, &pointer, 1);
    }
    jpeg_finish_compress(&info);
    jpeg_destroy_compress(&info);
    const auto* first = reinterpret_cast<const std::byte*>(data);
    Bytes bytes(first, first + size);
    std::free(data); // NOLINT: libjpeg's malloc()
    return bytes;
}

JpegSetup subsampled(int h, int v) {
    return [=](jpeg_compress_struct& info) {
        info.comp_info[0].h_samp_factor = h;
        info.comp_info[0].v_samp_factor = v;
    };
}

JpegMarkers marker(int which, const std::string& text) {
    return [=](jpeg_compress_struct& info) {
        jpeg_write_marker(&info, which, reinterpret_cast<const JOCTET*>(text.data()),
                          static_cast<unsigned int>(text.size()));
    };
}

} // namespace

SampleFiles jpegFiles() {
    SampleFiles files;
    const auto read = [&](std::string name, Bytes bytes) {
        files.read.push_back({std::move(name), "jpeg", std::move(bytes)});
    };
    const auto handedOn = [&](std::string name, Bytes bytes) {
        files.handedOn.push_back({std::move(name), "jpeg", std::move(bytes)});
    };
    const JpegSetup plain = [](jpeg_compress_struct&) {};
    const auto rgb = [](const JpegSetup& setup, const JpegMarkers& markers = {}) {
        return jpeg(JCS_RGB, 3, setup, markers);
    };

    read("plain", rgb(plain));
    read("grey", jpeg(JCS_GRAYSCALE, 1, plain));
    for (const auto& [h, v] : {std::pair{1, 1}, {2, 1}, {1, 2}, {2, 2}, {4, 1}, {4, 2}, {1, 4}})
        read("samples " + std::to_string(h) + " " + std::to_string(v), rgb(subsampled(h, v)));
    read("progressive", rgb([](auto& info) { jpeg_simple_progression(&info); }));
    read("progressive grey",
         jpeg(JCS_GRAYSCALE, 1, [](auto& info) { jpeg_simple_progression(&info); }));
    read("RGB stored as such", rgb([](auto& info) { jpeg_set_colorspace(&info, JCS_RGB); }));
    read("quality 5", rgb([](auto& info) { jpeg_set_quality(&info, 5, TRUE); }));
    read("restarts", rgb([](auto& info) { info.restart_interval = 2; }));
    read("arithmetic", rgb([](auto& info) { info.arith_code = TRUE; }));
    read("dots per inch", rgb([](auto& info) {
             info.density_unit = 1;
             info.X_density = 300;
             info.Y_density = 150;
         }));
    read("aspect", rgb([](auto& info) {
             info.X_density = 2;
             info.Y_density = 1;
         }));
    read("comments", rgb(plain, [](jpeg_compress_struct& info) {
             marker(JPEG_COM, "first")(info);
             marker(JPEG_COM, "second")(info);
         }));
    read("an unknown marker", rgb(plain, marker(JPEG_APP0 + 9, "whatever")));

    handedOn("CMYK", jpeg(JCS_CMYK, 4, plain));
    handedOn("YCCK", jpeg(JCS_CMYK, 4, [](auto& info) { jpeg_set_colorspace(&info, JCS_YCCK); }));
    handedOn("two channels", jpeg(JCS_UNKNOWN, 2, plain));
    // Orientation 6, which Patina leaves as it is
    handedOn("Exif", rgb(plain, marker(JPEG_APP0 + 1,
                                       std::string("Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0"
                                                   "\x01\0\0\0\x06\0\0\0\0\0\0\0",
                                                   32))));
    handedOn("XMP", rgb(plain, marker(JPEG_APP0 + 1, std::string("http://ns.adobe.com/xap/1.0/\0"
                                                                 "<x/>",
                                                                 33))));
    handedOn(
        "colour profile",
        rgb(plain, marker(JPEG_APP0 + 2, std::string("ICC_PROFILE\0\1\1", 14) + emptyProfile())));
    return files;
}

} // namespace patina::test
