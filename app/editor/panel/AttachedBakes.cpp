#include "app/editor/panel/AttachedBakes.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/job/BakeService.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/EditControl.h"
#include "app/editor/widget/TextButton.h"
#include "core/bake/Bake.h"
#include "core/bake/domain/BakeOptions.h"
#include "core/document/AbsentBake.h"

#include <QColor>
#include <QCoreApplication>
#include <QFile>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QStringList>
#include <QVBoxLayout>
#include <algorithm>
#include <optional>
#include <vector>

namespace patina::editor {
namespace {

// "Geometry, settings"
QString whatChanged(const BakeStaleness& staleness) {
    QStringList parts;
    if (staleness.geometry)
        parts << AttachedBakes::tr("geometry");
    if (staleness.albedo)
        parts << AttachedBakes::tr("albedo");
    if (staleness.light)
        parts << AttachedBakes::tr("light");
    return parts.join(QStringLiteral(", "));
}

// "1,024 rays, 3 bounces"; "in closed form, without rays"
QString holdsText(const BakeArtifact& bake) {
    if (!restsOnRays(bake))
        return AttachedBakes::tr("in closed form, without rays");
    QString text = AttachedBakes::tr("%1 rays").arg(QLocale().toString(bake.samplesDone));
    if (bake.bounces > 0)
        text += bake.bounces == 1 ? AttachedBakes::tr(", 1 bounce")
                                  : AttachedBakes::tr(", %1 bounces").arg(bake.bounces);
    return text;
}

// "Form differs: Rays 16384 (this bake: 1024)"; empty: it does not.
QString differenceText(const BakeArtifact& bake, const BakeRequest& wanted) {
    QStringList parts;
    for (const SettingDifference& difference : settingDifferences(bake, wanted))
        parts << AttachedBakes::tr("%1 %2 (this bake: %3)")
                     .arg(QCoreApplication::translate("BakeOptions", difference.label.c_str()),
                          QString::fromStdString(difference.wanted),
                          QString::fromStdString(difference.baked));
    return parts.isEmpty()
               ? QString()
               : AttachedBakes::tr("Form differs: %1").arg(parts.join(QStringLiteral(", ")));
}

} // namespace

AttachedBakes::AttachedBakes(DocumentController& controller, BakeService& bakes,
                             std::function<BakeRequest(BakeKind)> wanted,
                             std::function<void(const BakeRequest&)> resume, QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_bakes(bakes)
    , m_wanted(std::move(wanted))
    , m_resume(std::move(resume))
    , m_rows(new QVBoxLayout(this)) {
    m_rows->setContentsMargins(0, 0, 0, 0);
}

bool AttachedBakes::offers(const BakeRequest& request) const {
    const auto settings = settingsText(normalized(request));
    return std::ranges::any_of(m_controller.document().bakes, [&](const BakeArtifactPtr& bake) {
        return bake->kind == request.kind && stoppedEarly(*bake) &&
               settingsText(normalized(requestOf(*bake))) == settings;
    });
}

void AttachedBakes::refresh() {
    retireAll(*m_rows);
    const Document& document = m_controller.document();
    if (document.bakes.empty()) {
        auto* none = new QLabel(tr("None yet. A bake stays with the scene and is saved with it."));
        none->setObjectName(QStringLiteral("dim"));
        none->setWordWrap(true);
        m_rows->addWidget(none);
        return;
    }
    std::vector<BakeRequest> stale;
    for (const BakeArtifactPtr& bake : document.bakes) {
        if (isAbsent(*bake)) {
            addAbsentRow(*bake);
            continue;
        }
        const Hash albedo = bake->albedo == Hash{} ? Hash{} : m_bakes.currentAlbedo();
        const Hash light = bake->kind == BakeKind::LightMap ? m_bakes.currentLight() : Hash{};
        const BakeStaleness staleness =
            bakeStaleness(*bake, document, m_bakes.currentInputs(), albedo, light);
        if (staleness.stale())
            stale.push_back(requestOf(*bake));
        addRow(*bake, staleness);
    }
    if (stale.size() > 1) {
        QPushButton* all =
            makeTextButton(tr("Re-bake what is stale (%1)").arg(stale.size()),
                           tr("Puts every stale bake into the queue; what is up to date stays"));
        all->setObjectName(QStringLiteral("rebakeStale"));
        connect(all, &QPushButton::clicked, this, [this, stale] {
            for (const BakeRequest& request : stale)
                m_bakes.start(request);
        });
        m_rows->addWidget(all);
    }
}

void AttachedBakes::addRow(const BakeArtifact& bake, const BakeStaleness& staleness) {
    const bool stale = staleness.stale();
    const std::optional<StoppedBake> stopped = stoppedEarly(bake);
    QString status =
        stale     ? tr("Stale: %1").arg(whatChanged(staleness))
        : stopped ? tr("Stopped at %1 of %2 rays")
                        .arg(QLocale().toString(stopped->done), QLocale().toString(stopped->asked))
                  : tr("Up to date, %1").arg(holdsText(bake));
    QStringList reasons;
    for (const std::string& reason : staleness.reasons)
        reasons << QString::fromStdString(reason).toHtmlEscaped();
    if (!reasons.isEmpty())
        status += QStringLiteral("<br>") + reasons.join(QStringLiteral("<br>"));
    const auto colored = [](const QString& html, const QColor& color) {
        return QStringLiteral("<br><span style='color:%1'>%2</span>").arg(color.name(), html);
    };
    QString html = bakeTitle(bake.kind).toHtmlEscaped() +
                   colored(status, stale || stopped ? tokens::kCopper : tokens::kTextDim);
    if (const QString differs = differenceText(bake, m_wanted(bake.kind)); !differs.isEmpty())
        html += colored(differs.toHtmlEscaped(), tokens::kTextDim);
    // What the user should know of this bake, such as overlapping texture coordinates.
    if (!bake.note.empty())
        html += colored(QString::fromStdString(bake.note).toHtmlEscaped(), tokens::kTextDim);

    auto* row = new QWidget;
    auto* layout = new QVBoxLayout(row);
    layout->setContentsMargins(0, 2, 0, tokens::kGap);
    layout->setSpacing(tokens::kGap / 2);
    auto* text = new QLabel(html);
    text->setWordWrap(true);
    text->setObjectName(QStringLiteral("bakeStatus"));
    layout->addWidget(text);
    auto* buttons = new QHBoxLayout;
    buttons->addStretch(1);
    if (stale) {
        QPushButton* rebake = makeTextButton(
            tr("Re-bake"), tr("Bakes again with the settings this bake was made with"));
        rebake->setObjectName(QStringLiteral("rebake"));
        connect(rebake, &QPushButton::clicked, this,
                [this, request = requestOf(bake)] { m_bakes.start(request); });
        buttons->addWidget(rebake);
    } else if (stopped) {
        QPushButton* resume = makeTextButton(
            tr("Continue"), tr("Casts the remaining rays; the picture keeps this bake meanwhile"));
        resume->setObjectName(QStringLiteral("bakeContinue"));
        resume->setEnabled(!m_bakes.running());
        connect(resume, &QPushButton::clicked, this,
                [this, request = requestOf(bake)] { m_resume(request); });
        buttons->addWidget(resume);
    }
    buttons->addWidget(removeButton(bake.kind));
    layout->addLayout(buttons);
    m_rows->addWidget(row);
}

// A bake whose file could not be read: its reference stays with the scene until it is removed.
void AttachedBakes::addAbsentRow(const BakeArtifact& bake) {
    const QFileInfo file(QFile::decodeName(bake.missingFile.c_str()));
    auto* text = new QLabel(
        QStringLiteral("%1<br><span style='color:%2'>%3</span>")
            .arg(bakeTitle(bake.kind).toHtmlEscaped(), QColor(tokens::kCopper).name(),
                 tr("Missing: %1. Put the file back and open the project again, or bake anew.")
                     .arg(file.fileName())
                     .toHtmlEscaped()));
    text->setWordWrap(true);
    text->setObjectName(QStringLiteral("bakeMissing"));
    text->setToolTip(file.filePath());
    auto* row = new QWidget;
    auto* layout = new QVBoxLayout(row);
    layout->setContentsMargins(0, 2, 0, tokens::kGap);
    layout->addWidget(text);
    layout->addWidget(removeButton(bake.kind), 0, Qt::AlignRight);
    m_rows->addWidget(row);
}

QPushButton* AttachedBakes::removeButton(BakeKind kind) {
    QPushButton* remove = makeTextButton(tr("Remove"), tr("Detaches this bake from the scene"));
    connect(remove, &QPushButton::clicked, this, [this, kind] { m_controller.removeBake(kind); });
    return remove;
}

} // namespace patina::editor
