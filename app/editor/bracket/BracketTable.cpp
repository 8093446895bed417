#include "app/editor/bracket/BracketTable.h"

#include "app/editor/document/QtText.h"
#include "app/editor/widget/ControlHelp.h"

#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QHeaderView>
#include <QSignalBlocker>
#include <QWheelEvent>
#include <algorithm>

namespace patina::editor {
namespace {

constexpr double kMostStops = 30.0; // either way
constexpr int kLeastColumn = 62;
constexpr int kFieldFrame = 20;  // of a number, which its size hint leaves out
constexpr int kLeastWidth = 580; // a name of a dozen letters beside an exposure in full
constexpr double kThirdOfAStop = 1.0 / 3.0;

// Of the wheel it takes nothing that is meant for the list.
class EvField : public QDoubleSpinBox {
  protected:
    void wheelEvent(QWheelEvent* event) override {
        if (hasFocus())
            QDoubleSpinBox::wheelEvent(event);
        else
            event->ignore();
    }
};

QString shareText(double share) {
    return share > 0.0 && share < 0.001 ? BracketTable::tr("< 0.1 %")
                                        : BracketTable::tr("%1 %").arg(100.0 * share, 0, 'f', 1);
}

} // namespace

BracketTable::BracketTable(const QStringList& photos, QWidget* parent)
    : QTableWidget(static_cast<int>(photos.size()), 6, parent)
    , m_photos(photos)
    , m_evs(static_cast<std::size_t>(photos.size())) {
    setObjectName(QStringLiteral("bracketPhotos"));
    setAccessibleName(tr("Photos"));
    setHorizontalHeaderLabels(
        {tr("Photo"), tr("Exposure"), tr("EV"), tr("Shift"), tr("White"), tr("Black")});
    const char* help[] = {QT_TR_NOOP("File"),
                          QT_TR_NOOP("Shutter, aperture and sensitivity, as the file says (Exif)"),
                          QT_TR_NOOP("Exposure in stops; only differences count"),
                          QT_TR_NOOP("Pixels by which the photo was moved, right and down"),
                          QT_TR_NOOP("Pixels with a channel at the top"),
                          QT_TR_NOOP("Pixels with a channel at zero")};
    for (int column = 0; column < columnCount(); ++column)
        horizontalHeaderItem(column)->setToolTip(tr(help[column]));
    horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    horizontalHeader()->setSectionResizeMode(Photo, QHeaderView::Stretch);
    horizontalHeader()->setMinimumSectionSize(kLeastColumn);
    setMinimumWidth(kLeastWidth);
    horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    verticalHeader()->hide();
    setWordWrap(false);
    setTextElideMode(Qt::ElideMiddle); // numbers of photos stand at the end of their names
    setEditTriggers(NoEditTriggers);
    setSelectionMode(NoSelection);
    setFocusPolicy(Qt::NoFocus); // of its fields, not of cells
    setShowGrid(false);
    setAlternatingRowColors(true);
    for (int row = 0; row < rowCount(); ++row) {
        const QString name = shownFileName(photos[row]);
        set(row, Photo, name, photos[row]);
        auto* ev = describe(new EvField, tr("Exposure of %1").arg(name),
                            tr("Exposure of this photo in stops; only the differences between "
                               "photos count"));
        ev->setObjectName(QStringLiteral("bracketEv%1").arg(row));
        ev->setRange(-kMostStops, kMostStops);
        ev->setDecimals(2);
        ev->setSingleStep(kThirdOfAStop);
        ev->setKeyboardTracking(false); // each change computes anew
        ev->setFocusPolicy(Qt::StrongFocus);
        setCellWidget(row, Ev, ev);
        horizontalHeader()->setSectionResizeMode(Ev, QHeaderView::Fixed);
        horizontalHeader()->resizeSection(Ev, ev->sizeHint().width() + kFieldFrame);
        connect(ev, &QDoubleSpinBox::valueChanged, this, [this, row](double value) {
            m_evs[static_cast<std::size_t>(row)] = value;
            Q_EMIT exposureTyped();
        });
    }
    verticalHeader()->setDefaultSectionSize(verticalHeader()->defaultSectionSize() + 4);
}

void BracketTable::set(int row, Column column, const QString& text, const QString& help) {
    auto* cell = new QTableWidgetItem(text);
    cell->setToolTip(help.isEmpty() ? text : help);
    setItem(row, column, cell);
}

void BracketTable::setExposures(const std::vector<PhotoExposure>& exposures,
                                const std::vector<double>& evs) {
    for (int row = 0; row < rowCount(); ++row) {
        const auto at = static_cast<std::size_t>(row);
        const std::string text = exposureText(exposures[at]);
        set(row, Exposure, text.empty() ? tr("not in the file") : QString::fromStdString(text));
        auto* ev = static_cast<QDoubleSpinBox*>(cellWidget(row, Ev));
        const QSignalBlocker typed(ev);
        m_evs[at] = evs.empty() ? 0.0 : evs[at];
        ev->setValue(m_evs[at]);
    }
}

void BracketTable::setFound(const BracketReport& report) {
    for (int row = 0; row < rowCount(); ++row) {
        const auto found = std::find_if(
            report.photos.begin(), report.photos.end(),
            [&](const BracketPhoto& photo) { return photo.file == toPath(m_photos[row]); });
        if (found == report.photos.end())
            continue;
        set(row, Shift, tr("%1, %2 px").arg(-found->shift.dx).arg(-found->shift.dy));
        set(row, White, shareText(found->white));
        set(row, Black, shareText(found->black));
    }
}

void BracketTable::clearFound() {
    for (int row = 0; row < rowCount(); ++row)
        for (const Column column : {Shift, White, Black})
            set(row, column, {});
}

} // namespace patina::editor
