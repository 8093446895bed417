#include "app/cli/RenderViews.h"

#include "app/cli/Numbers.h"
#include "app/cli/Report.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/edit/ViewReasons.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/mix/LightMix.h"
#include "core/sheet/SheetCanvas.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace patina::cli {
namespace {

using render::ViewChoice;
using render::ViewMode;
using render::ViewRange;

std::string viewNames() {
    std::string names;
    for (const ViewInfo& info : views())
        names += fmt::format("{}{}", names.empty() ? "" : ", ", info.id);
    return names;
}

bool hasNumbers(const ViewInfo& info) {
    return info.value != ViewValue::Picture && info.coversSurface;
}

// Channels of a part: which of the four floats, under which names.
struct Channels {
    int colors;
    std::vector<std::string> names;
};

Channels channelsOf(const ViewChoice& choice) {
    const ViewInfo& info = viewInfo(choice.kind);
    if (choice.mode == ViewMode::Contribution)
        return {3, {"R", "G", "B", "A"}};
    switch (info.value) {
    case ViewValue::Scalar:
        return {1, {choice.kind == shading::kViewDepth ? "Z" : "Y", "A"}};
    case ViewValue::Identity:
        return {1, {"id", "A"}};
    case ViewValue::Direction:
        return {3, {"X", "Y", "Z", "A"}};
    default:
        return {3, {"R", "G", "B", "A"}};
    }
}

// --- Contact sheet

constexpr int kColumns = 6, kMargin = 16, kGap = 12;
constexpr int kHeading = 20, kLabel = 14, kSmall = 11; // pixels per em
constexpr int kCaption = 42, kHeadingRow = 44;
constexpr int kLine = 20, kReasonIndent = 150; // of what does not apply

// What only steps or a click in the editor fill.
std::string whyNotHere(ViewKind kind) {
    if (kind == shading::kViewUnshot)
        return "Light is shot step by step in the editor's Radiosity dock alone.";
    if (kind == shading::kViewFormFactor)
        return "The element that form factors are of is chosen in the editor.";
    return {};
}

// Of all views.
std::string whyLeftOut(const ViewInfo& info, const Document& document, Id light) {
    std::string reason = whyEmpty(info.kind, document, light);
    // Nothing is solved for some of them alone.
    if (reason.empty() && info.lighting == LightingMode::Radiosity &&
        document.view.lighting != LightingMode::Radiosity)
        reason = "The scene is not lit by radiosity (--lighting radiosity).";
    return reason.empty() ? whyNotHere(info.kind) : reason;
}

std::string number(float value) {
    return fmt::format("{:.3g}", value);
}

// "0 [bar] 1 m": the colours that the numbers have.
void drawLegend(Image& sheet, const TextRaster& text, int x, int baseline, const ViewInfo& info,
                const ViewRange& range) {
    constexpr int kBar = 84;
    const std::string low = number(range.min);
    text.draw(sheet, x, baseline, kSmall, sheet::kGrey, low);
    x += text.width(low, kSmall) + 6;
    for (int i = 0; i < kBar; ++i)
        sheet::fillRectangle(sheet, x + i, baseline - 8, 1, 8,
                             mapColor(info.colorMap, static_cast<float>(i) / (kBar - 1)));
    x += kBar + 6;
    const std::string high =
        fmt::format("{}{}{}{}", number(range.max), info.unit.empty() ? "" : " ", info.unit,
                    info.logarithmic ? "  log" : "");
    text.draw(sheet, x, baseline, kSmall, sheet::kGrey, high);
}

struct Sheet {
    std::vector<const ViewInfo*> shown;
    int tileWidth, tileHeight;

    // Where each tile lies; returns the height of the sheet.
    template <class Heading, class Tile>
    int layOut(Heading heading, Tile tile) const {
        int y = kMargin, column = 0;
        const ViewInfo* last = nullptr;
        for (const ViewInfo* info : shown) {
            if (!last || last->group != info->group) {
                if (column > 0)
                    y += tileHeight + kCaption + kGap;
                column = 0;
                heading(y, viewGroupLabel(info->group));
                y += kHeadingRow;
            } else if (column == kColumns) {
                column = 0;
                y += tileHeight + kCaption + kGap;
            }
            tile(kMargin + column * (tileWidth + kGap), y, *info);
            ++column;
            last = info;
        }
        return y + tileHeight + kCaption + kMargin;
    }
};

} // namespace

std::string listViews() {
    std::string text;
    for (int group = 0; group < kViewGroupCount; ++group) {
        text += fmt::format("{}{}\n", group > 0 ? "\n" : "",
                            viewGroupLabel(static_cast<ViewGroup>(group)));
        for (const ViewInfo& info : views())
            if (info.group == static_cast<ViewGroup>(group))
                text += fmt::format("  {:<20} {}{}\n", info.id, info.help,
                                    info.unit.empty() ? "" : fmt::format(" [{}]", info.unit));
    }
    return text;
}

bool wantsAllViews(const RenderOptions& options) {
    return options.view == "all";
}

Result<render::ViewSettings> viewSettings(const RenderOptions& options, const Document& document) {
    render::ViewSettings settings;
    if (!options.view.empty() && !wantsAllViews(options)) {
        const ViewInfo* info = findView(options.view);
        if (!info)
            return usageError(fmt::format("there is no view \"{}\"; --view wants all or one of {}",
                                          options.view, viewNames()));
        settings.shown.kind = info->kind;
    }
    if (options.viewMode == "contribution") {
        settings.shown.mode = ViewMode::Contribution;
        if (!wantsAllViews(options) && viewInfo(settings.shown.kind).contribution.empty())
            return usageError(fmt::format("the view \"{}\" has no contribution of its own to the "
                                          "picture; leave --view-mode out",
                                          viewInfo(settings.shown.kind).id));
    }
    if (!options.viewRange.empty()) {
        std::vector<float> range;
        if (!parseNumbers(options.viewRange, ',', range) || range.size() != 2 ||
            !(range[0] < range[1]))
            return usageError(fmt::format(
                "--view-range wants MIN,MAX with MIN below MAX, not \"{}\"", options.viewRange));
        settings.shown.range = ViewRange{range[0], range[1]};
    }
    if (!options.viewLight.empty()) {
        const auto light =
            std::find_if(document.lights.begin(), document.lights.end(), [&](const Light& l) {
                return l.name == options.viewLight && isActive(document, l);
            });
        if (light == document.lights.end()) {
            std::string names;
            for (const Light& l : document.lights)
                if (isActive(document, l))
                    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", l.name);
            return usageError(
                names.empty()
                    ? "--view-light: no light of this scene is on"
                    : fmt::format("--view-light: no light named \"{}\" is on; these are: {}",
                                  options.viewLight, names));
        }
        settings.light = light->id;
    }
    if (wantsAllViews(options))
        return settings;
    const ViewKind kind = settings.shown.kind;
    std::string reason = whyEmpty(kind, document, settings.light);
    if (reason.empty())
        reason = whyNotHere(kind);
    if (!reason.empty())
        return usageError(fmt::format(
            "the view \"{}\" does not apply to this scene: {}{}", viewInfo(kind).id, reason,
            viewInfo(kind).ofTransfer && !hasTransfer(document)
                ? " Compute one with \"patina bake prt\" and add it with --bake."
                : ""));
    return settings;
}

std::vector<LeftOut> leftOutViews(const Document& document, const render::ViewSettings& settings) {
    std::vector<LeftOut> left;
    for (const ViewInfo& info : views()) {
        if (settings.shown.mode == ViewMode::Contribution && info.contribution.empty())
            continue;
        if (std::string reason = whyLeftOut(info, document, settings.light); !reason.empty())
            left.push_back({&info, std::move(reason)});
    }
    return left;
}

Result<Image> viewNumbers(render::ViewRenderer& renderer, const ViewChoice& choice) {
    if (!hasNumbers(viewInfo(choice.kind)))
        return usageError(
            fmt::format("the view \"{}\" judges the displayed picture and has no numbers; "
                        "write it as .png",
                        viewInfo(choice.kind).id));
    Result<Image> read = renderer.readView(choice.kind, choice.mode);
    if (!read)
        return read;
    const Channels channels = channelsOf(choice);
    Image image(read->width(), read->height(), channels.colors + 1, PixelType::F32,
                ColorEncoding::Linear);
    const auto from = read->f32();
    const auto to = image.f32();
    const auto colors = static_cast<std::size_t>(channels.colors);
    for (std::size_t i = 0; i < from.size() / 4; ++i) {
        std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(4 * i), colors,
                    to.begin() + static_cast<std::ptrdiff_t>((colors + 1) * i));
        to[(colors + 1) * i + colors] = from[4 * i + 3];
    }
    image.setChannelNames(channels.names);
    return image;
}

Result<std::vector<ImagePart>> viewParts(render::ViewRenderer& renderer, const Document& document,
                                         const render::ViewSettings& settings) {
    const ViewMode mode = settings.shown.mode;
    std::vector<ImagePart> parts;
    const auto add = [&](std::string_view name, std::string_view label, std::string_view unit,
                         Image image) {
        ImagePart part;
        part.name = name;
        part.image = std::move(image);
        part.attributes["patina:view"] = label;
        if (!unit.empty())
            part.attributes["patina:units"] = unit;
        parts.push_back(std::move(part));
    };
    // Before other numbers take the picture's place.
    const ViewInfo& final = viewInfo(shading::kViewFinal);
    if (mode == ViewMode::Raw) {
        add(final.id, final.label, final.unit, renderer.readLinear());
        Result<Image> background = renderer.readBackground();
        if (!background)
            return background.error();
        add("background", "Background", final.unit, std::move(*background));
    }
    for (const ViewInfo& info : views()) {
        if (!hasNumbers(info) || (mode == ViewMode::Contribution && info.contribution.empty()) ||
            (mode == ViewMode::Raw && info.kind == final.kind) ||
            !whyLeftOut(info, document, settings.light).empty())
            continue;
        Result<Image> numbers = viewNumbers(renderer, {info.kind, mode, {}});
        if (!numbers)
            return numbers.error();
        add(info.id, info.label, info.unit, std::move(*numbers));
    }
    return parts;
}

Result<Image> contactSheet(Session& session, render::ViewRenderer& renderer,
                           const Document& document, render::FrameSettings frame) {
    Result<TextRaster> text = TextRaster::create();
    if (!text)
        return text.error();
    const ViewMode mode = frame.view.shown.mode;
    Sheet sheet{{}, frame.width, frame.height};
    for (const ViewInfo& info : views())
        if ((mode == ViewMode::Raw || !info.contribution.empty()) &&
            whyLeftOut(info, document, frame.view.light).empty())
            sheet.shown.push_back(&info);
    const std::vector<LeftOut> left = leftOutViews(document, frame.view);
    const int width = 2 * kMargin + kColumns * frame.width + (kColumns - 1) * kGap;
    const int below = sheet.layOut([](int, std::string_view) {}, [](int, int, const ViewInfo&) {});
    const int height =
        below + (left.empty() ? 0 : kHeadingRow + static_cast<int>(left.size()) * kLine + kMargin);
    if (std::max(width, height) > sheet::kMostSheetSide)
        return usageError(
            fmt::format("the contact sheet would have more than {} pixels a side; choose a "
                        "smaller --size for its pictures",
                        sheet::kMostSheetSide));
    // Numbers are drawn without anti-aliasing: twice as large, then averaged.
    if (frame.samples > 1) {
        frame.width *= 2;
        frame.height *= 2;
    }
    Image image = sheet::makePaper(width, height);

    Result<void> done;
    sheet.layOut(
        [&](int y, std::string_view label) {
            text->draw(image, kMargin, y + 28, kHeading, sheet::kWhite, label);
        },
        [&](int x, int y, const ViewInfo& info) {
            if (!done || session.job().cancelled())
                return;
            frame.view.shown.kind = info.kind;
            done = renderer.render(frame, 0);
            if (!done)
                return;
            sheet::paste(
                image, x, y,
                shrinkImage(renderer.readDisplayed(), std::max(sheet.tileWidth, sheet.tileHeight)));
            const int first = y + sheet.tileHeight + 18, second = first + 17;
            text->draw(image, x, first, kLabel, sheet::kWhite,
                       sheet::fitting(*text, info.label, kLabel, sheet.tileWidth));
            const auto range = mode == ViewMode::Raw ? renderer.shownRange() : std::nullopt;
            if (range)
                drawLegend(image, *text, x, second, info, *range);
            else
                text->draw(image, x, second, kSmall, sheet::kGrey,
                           sheet::fitting(*text,
                                          mode == ViewMode::Raw ? info.help : info.contribution,
                                          kSmall, sheet.tileWidth));
        });
    if (!done)
        return done.error();
    if (!left.empty())
        text->draw(image, kMargin, below + 28, kHeading, sheet::kWhite,
                   "Does not apply to this scene");
    int baseline = below + kHeadingRow + kLine - 4;
    for (const LeftOut& one : left) {
        text->draw(image, kMargin, baseline, kLabel, sheet::kWhite, one.view->label);
        const int x = kMargin + kReasonIndent;
        text->draw(image, x, baseline, kLabel, sheet::kAmber,
                   sheet::fitting(*text, one.reason, kLabel, width - kMargin - x));
        baseline += kLine;
    }
    return image;
}

} // namespace patina::cli
