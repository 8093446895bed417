#include "app/editor/radiosity/LeakList.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/radiosity/RadiosityTexts.h"
#include "app/editor/radiosity/RadiosityUpdater.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/trace/ViewLines.h"
#include "app/editor/widget/ControlHelp.h"
#include "app/editor/widget/PlotStyle.h"
#include "app/editor/widget/TextButton.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>

namespace patina::editor {
namespace {

enum LeakColumn { kWhere, kWhat, kHowMuch, kLeakColumns };
constexpr int kLeakElementRole = Qt::UserRole;
constexpr QSize kAnyView(1000, 600); // whose middle a place is in, roughly

QString lengthWords(double metres) {
    return metres < 0.01 ? LeakList::tr("%1 mm").arg(plotNumber(1e3 * metres, 2))
                         : LeakList::tr("%1 cm").arg(plotNumber(1e2 * metres, 2));
}

// Looked at from where the camera is, unless the place is out of its sight.
void bringIntoView(DocumentController& controller, const glm::vec3& place) {
    Camera camera = controller.document().view.camera;
    const auto at = ViewLines(camera, kAnyView).point(place);
    if (at && QRectF(QPointF(0, 0), QSizeF(kAnyView)).contains(*at))
        return;
    camera.target = place;
    controller.setCamera(camera);
}

} // namespace

LeakList::LeakList(RadiosityUpdater& radiosity, DocumentController& controller, QWidget* parent)
    : QWidget(parent)
    , m_radiosity(radiosity)
    , m_controller(controller) {
    m_find = makeTextButton(tr("Find Leaks and Seams"),
                            tr("Lists where light comes to where it may not: gaps, and elements on "
                               "both sides of a wall; and where it jumps between surfaces that are "
                               "not joined"));
    m_find->setObjectName(QStringLiteral("radiosityFindLeaks"));
    connect(m_find, &QPushButton::clicked, this, [this] { m_radiosity.findLeaks(); });
    m_text = new QLabel;
    m_text->setObjectName(QStringLiteral("radiosityLeakText"));
    m_text->setWordWrap(true);
    m_list = describe(new QTreeWidget, tr("Leaks and seams"),
                      tr("The worst first; a click chooses the element and shows it"));
    m_list->setObjectName(QStringLiteral("radiosityLeaks"));
    m_list->setColumnCount(kLeakColumns);
    m_list->setHeaderLabels({tr("Where"), tr("What"), tr("Light")});
    m_list->headerItem()->setToolTip(
        kHowMuch, tr("Of a leak the power that is on the wrong side, of a seam the jump of the "
                     "radiosity; red, green and blue together"));
    m_list->setUniformRowHeights(true);
    m_list->setIndentation(14);
    m_list->setMinimumHeight(90);
    m_list->header()->setStretchLastSection(false);
    m_list->header()->setSectionResizeMode(kWhere, QHeaderView::Stretch);
    m_list->header()->setSectionResizeMode(kWhat, QHeaderView::ResizeToContents);
    m_list->header()->setSectionResizeMode(kHowMuch, QHeaderView::ResizeToContents);
    connect(m_list, &QTreeWidget::currentItemChanged, this, [this](const QTreeWidgetItem* item) {
        if (item == nullptr || !item->data(kWhere, kLeakElementRole).isValid() ||
            m_listed != m_radiosity.leaks())
            return;
        const auto element = item->data(kWhere, kLeakElementRole).toUInt();
        m_radiosity.choose(element);
        bringIntoView(m_controller, elementCentre(*m_radiosity.live(), element));
    });
    auto* top = new QHBoxLayout;
    top->setSpacing(tokens::kGap);
    top->addWidget(m_find);
    top->addWidget(m_text, 1);
    auto* rows = new QVBoxLayout(this);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(tokens::kGap / 2);
    rows->addLayout(top);
    rows->addWidget(m_list, 1);
}

void LeakList::refresh() {
    const bool solved = m_radiosity.live() && m_radiosity.live()->solved;
    m_find->setEnabled(solved && !m_radiosity.findingLeaks());
    const auto& found = m_radiosity.leaks();
    if (m_radiosity.findingLeaks())
        m_text->setText(tr("Looking…"));
    else if (!found)
        m_text->setText(solved ? QString() : tr("Once the light is solved."));
    else if (found->leaks.empty() && found->seams.empty())
        m_text->setText(tr("No leaks and no seams."));
    else
        m_text->setText(tr("%1 leaks · %2 seams")
                            .arg(QLocale().toString(static_cast<qulonglong>(found->leaks.size())),
                                 QLocale().toString(static_cast<qulonglong>(found->seams.size()))));
    if (found != m_listed)
        list();
}

void LeakList::list() {
    m_listed = m_radiosity.leaks();
    m_list->clear();
    if (!m_listed || !m_radiosity.live())
        return;
    const Document& document = m_controller.document();
    const LiveRadiosity& live = *m_radiosity.live();
    const auto group = [&](const QString& title, std::size_t count) {
        auto* top = new QTreeWidgetItem(
            m_list,
            {count > kMostListed ? tr("%1, the worst %2").arg(title).arg(kMostListed) : title});
        top->setFirstColumnSpanned(true);
        return top;
    };
    const auto add = [&](QTreeWidgetItem* top, std::uint32_t element, const QString& what,
                         const QString& howMuch, const QString& help) {
        auto* item =
            new QTreeWidgetItem(top, {elementName(document, live, element), what, howMuch});
        item->setTextAlignment(kHowMuch, Qt::AlignRight | Qt::AlignVCenter);
        item->setData(kWhere, kLeakElementRole, element);
        for (int part = 0; part < kLeakColumns; ++part)
            item->setToolTip(part, help);
    };
    auto* leaks = group(tr("Leaks"), m_listed->leaks.size());
    for (std::size_t i = 0; i < std::min(m_listed->leaks.size(), kMostListed); ++i) {
        const LightLeak& leak = m_listed->leaks[i];
        const bool divided = leak.kind == LightLeak::Kind::Divided;
        add(leaks, leak.element,
            divided ? tr("divided, %1").arg(flowPercent(leak.share))
                    : tr("gap, %1").arg(lengthWords(leak.width)),
            tr("%1 W").arg(plotNumber(leak.power, 2)),
            divided ? tr("Another surface stands on this element, and %1 of it are on the other "
                         "side. It has one radiosity for both: divide the scene more finely, or so "
                         "that elements end at the wall.")
                          .arg(flowPercent(leak.share))
                    : tr("This edge ends %1 short of another surface, and light goes through. Move "
                         "or extend the surface.")
                          .arg(lengthWords(leak.width)));
    }
    auto* seams = group(tr("Seams"), m_listed->seams.size());
    for (std::size_t i = 0; i < std::min(m_listed->seams.size(), kMostListed); ++i) {
        const LightSeam& seam = m_listed->seams[i];
        add(seams, seam.element,
            seam.width > 0.0 ? tr("crack, %1").arg(lengthWords(seam.width))
            : seam.sameMesh  ? tr("not joined")
                             : tr("two meshes"),
            tr("%1 W/m²").arg(plotNumber(seam.jump, 2)),
            tr("Light jumps by %1 to %2, which goes on from here. Join the two: shared vertices, "
               "no cracks, no vertices within edges.")
                .arg(flowPercent(seam.share), elementName(document, live, seam.other)));
    }
    leaks->setExpanded(true);
    seams->setExpanded(true);
}

} // namespace patina::editor
