#include "core/io/DisplayTransform.h"

#include "core/base/InputFile.h"
#include "core/worker/WorkerClient.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>

namespace patina {

namespace {

using nlohmann::json;

constexpr std::size_t kMaxConfigBytes = std::size_t{64} << 20;
constexpr std::size_t kMaxShaderBytes = std::size_t{4} << 20;
constexpr std::size_t kMaxTableValues = std::size_t{32} << 20;
constexpr int kMaxTableSide = 8192;
constexpr std::size_t kMaxTables = 15; // texture units beside the picture's

Result<WorkerClient::Reply> ask(WorkerClient& worker, const std::string& config, json header) {
    const auto input = openInputFile(config, kMaxConfigBytes);
    if (!input)
        return input.error();
    // Paths are bytes, not text.
    header["path"] = json::array();
    const std::filesystem::path readable = insideCanonicalFolder(config);
    for (const char c : readable.native())
        header["path"].push_back(static_cast<int>(static_cast<unsigned char>(c)));
    return worker.request(WorkerKind::OpenImageIo, header.dump(), input->fd.get(), config, {},
                          readable);
}

// Runs `read` on the answer; what makes no sense in it is an error of the file.
template <class T, class Read>
Result<T> believe(const Result<WorkerClient::Reply>& reply, const std::string& config, Read read) {
    if (!reply)
        return reply.error();
    try {
        return read(json::parse(reply->header));
    } catch (const std::exception& exception) {
        return Error{ErrorKind::InputBroken, "the configuration could not be understood", config,
                     exception.what()};
    }
}

void require(bool condition, const char* what) {
    if (!condition)
        throw std::runtime_error(what);
}

DisplayTransform::Table readTable(const json& entry, std::span<const std::byte>& payload) {
    DisplayTransform::Table table;
    table.sampler = entry.at("sampler");
    table.width = entry.at("width");
    table.height = entry.at("height");
    table.depth = entry.at("depth");
    table.channels = entry.at("channels");
    table.linear = entry.at("linear");
    const auto isSide = [](int side, int least) { return side >= least && side <= kMaxTableSide; };
    require(isSide(table.width, 1) && isSide(table.height, 0) && isSide(table.depth, 0) &&
                (table.depth == 0 || table.height > 0),
            "size of a table");
    require(table.channels == 1 || table.channels == 3, "channels of a table");
    const std::size_t count = static_cast<std::size_t>(table.width) *
                              static_cast<std::size_t>(std::max(table.height, 1)) *
                              static_cast<std::size_t>(std::max(table.depth, 1)) *
                              static_cast<std::size_t>(table.channels);
    require(count <= kMaxTableValues && count * sizeof(float) <= payload.size(),
            "values of a table");
    table.values.resize(count);
    std::memcpy(table.values.data(), payload.data(), count * sizeof(float));
    payload = payload.subspan(count * sizeof(float));
    return table;
}

} // namespace

std::string openColorIoConfig(const std::string& chosen) {
    std::string file = chosen;
    if (file.empty())
        if (const char* variable = std::getenv("OCIO"))
            file = variable;
    if (file.empty())
        return {};
    std::error_code error;
    const std::filesystem::path absolute = std::filesystem::absolute(file, error);
    return error ? file : absolute.string();
}

const DisplayMenu::Display* DisplayMenu::find(const std::string& name) const {
    const std::string& wanted = name.empty() ? defaultDisplay : name;
    const auto found = std::find_if(displays.begin(), displays.end(),
                                    [&](const Display& display) { return display.name == wanted; });
    return found == displays.end() ? nullptr : &*found;
}

Result<DisplayMenu> loadDisplayMenu(WorkerClient& worker, const std::string& config) {
    return believe<DisplayMenu>(
        ask(worker, config, {{"op", "displayMenu"}}), config, [](const json& header) {
            DisplayMenu menu;
            for (const json& entry : header.at("displays")) {
                DisplayMenu::Display display;
                display.name = entry.at("name");
                display.defaultView = entry.at("defaultView");
                display.views = entry.at("views").get<std::vector<std::string>>();
                menu.displays.push_back(std::move(display));
            }
            menu.defaultDisplay = header.at("defaultDisplay");
            require(menu.find({}) != nullptr, "default display");
            return menu;
        });
}

Result<DisplayTransform> loadDisplayTransform(WorkerClient& worker, const std::string& config,
                                              const std::string& display, const std::string& view) {
    const auto reply =
        ask(worker, config, {{"op", "displayTransform"}, {"display", display}, {"view", view}});
    return believe<DisplayTransform>(reply, config, [&](const json& header) {
        DisplayTransform transform;
        transform.config = config;
        transform.display = header.at("display");
        transform.view = header.at("view");
        transform.space = header.at("space");
        transform.shader = header.at("shader");
        require(transform.shader.size() <= kMaxShaderBytes, "shader");
        std::span<const std::byte> payload = reply->payload.bytes();
        for (const json& entry : header.at("tables"))
            transform.tables.push_back(readTable(entry, payload));
        require(transform.tables.size() <= kMaxTables, "number of tables");
        transform.curve = header.at("curve").get<std::vector<float>>();
        require(transform.curve.size() > 1 &&
                    std::all_of(transform.curve.begin(), transform.curve.end(),
                                [](float value) { return std::isfinite(value); }),
                "curve");
        return transform;
    });
}

} // namespace patina
