#include "app/editor/wall/CompareControls.h"

#include "app/editor/style/Tokens.h"
#include "app/editor/wall/WallComparison.h"
#include "app/editor/wall/WallLayout.h"
#include "app/editor/wall/WallState.h"
#include "app/editor/widget/FlowLayout.h"
#include "app/editor/widget/ListButton.h"
#include "app/editor/widget/NumberField.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QLabel>
#include <QList>
#include <QSignalBlocker>
#include <QToolButton>
#include <cmath>
#include <utility>

namespace patina::editor {
namespace {

constexpr int kCompareWidth = 64;
// Beside the numbers of cells.
constexpr int kNothing = -1, kThisFile = -2, kChooseFile = -3;

void describe(QWidget& widget, const QString& name, const QString& tip) {
    widget.setAccessibleName(name);
    widget.setToolTip(tip);
    widget.setStatusTip(tip);
}

NumberField* makeNumber(double least, double most, int decimals, const QString& unit) {
    NumberFormat format;
    format.softMin = format.hardMin = least;
    format.softMax = format.hardMax = most;
    format.decimals = decimals;
    format.unit = unit;
    auto* field = new NumberField(format);
    field->setFixedWidth(kCompareWidth);
    return field;
}

// Asks for the width of the widest text it has shown, and of all the numbers from the start. Were
// it only that of its text, the bar would wrap when the numbers come, the picture would become
// smaller by a row and be measured anew, and so on without end.
class SteadyLabel : public QLabel {
  public:
    explicit SteadyLabel(const QString& widest) {
        setText(widest);
        m_widest = QLabel::sizeHint();
        clear();
    }
    QSize sizeHint() const override { return m_widest = m_widest.expandedTo(QLabel::sizeHint()); }

  private:
    mutable QSize m_widest;
};

QString numbersText(const QString& rmse, const QString& psnr, const QString& relMse,
                    const QString& flip, const QString& most, const QString& x, const QString& y) {
    return CompareControls::tr("RMSE %1   PSNR %2 dB   relMSE %3   FLIP %4, largest %5 at %6, %7")
        .arg(rmse, psnr, relMse, flip, most, x, y);
}

} // namespace

CompareControls::CompareControls(WallState& wall, WallComparison& comparison, QWidget* parent)
    : QWidget(parent)
    , m_wall(wall)
    , m_comparison(comparison)
    , m_other(new QComboBox)
    , m_mode(new QComboBox)
    , m_blend(makeNumber(0.0, 100.0, 0, QStringLiteral(" %")))
    , m_rate(makeNumber(0.5, 10.0, 1, tr(" Hz")))
    , m_visible(new QCheckBox(tr("Only visible")))
    , m_stretch(new QCheckBox(tr("Stretch")))
    , m_match(new QCheckBox(tr("Match exposure")))
    , m_swap(makeListButton(QStringLiteral("redo"), {}, tr("Swap A and B")))
    , m_numbers(new SteadyLabel(numbersText(QStringLiteral("0.000888"), QStringLiteral("88.8"),
                                            QStringLiteral("0.000888"), QStringLiteral("0.888"),
                                            QStringLiteral("0.88"), QStringLiteral("8888"),
                                            QStringLiteral("8888")))) {
    auto* row = new FlowLayout(tokens::kGap, tokens::kGap / 2, this);
    row->setContentsMargins(0, 0, 0, 0);
    auto* label = new QLabel(tr("Compare with"));
    describe(*m_other, tr("Compare with"),
             tr("What the enlarged cell is compared with: another one (Ctrl + click it), or a "
                "picture from a file"));
    describe(*m_mode, tr("Compare by"), tr("How both cells are shown; hold Space to see B alone"));
    m_mode->addItem(tr("Wipe"), static_cast<int>(CompareMode::Wipe));
    m_mode->addItem(tr("Flicker"), static_cast<int>(CompareMode::Flicker));
    m_mode->addItem(tr("Blend"), static_cast<int>(CompareMode::Blend));
    m_mode->addItem(tr("Difference, signed"), static_cast<int>(CompareMode::Signed));
    m_mode->addItem(tr("Difference, absolute"), static_cast<int>(CompareMode::Absolute));
    m_mode->addItem(tr("Difference, relative"), static_cast<int>(CompareMode::Relative));
    m_mode->addItem(tr("Visible difference (FLIP)"), static_cast<int>(CompareMode::Visible));
    describe(*m_blend, tr("Share of B"), tr("How much of B is shown: 0 % is A, 100 % is B"));
    describe(*m_rate, tr("Flicker rate"), tr("How many pictures are shown per second"));
    describe(*m_visible, tr("Only visible"),
             tr("Hides differences that a viewer would not notice"));
    describe(*m_stretch, tr("Stretch"),
             tr("Gives the picture the cell's proportions, which are others"));
    describe(*m_match, tr("Match exposure"),
             tr("Brightens the picture until its mean luminance is that of the cell"));
    m_numbers->setObjectName(QStringLiteral("compareNumbers"));
    m_numbers->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_numbers->setToolTip(tr(
        "A against B, of the pictures as displayed: root mean square error, peak signal-to-noise "
        "ratio, relative mean square error, and FLIP: how visible the difference is, 0 to 1"));
    for (QWidget* widget : {static_cast<QWidget*>(label), static_cast<QWidget*>(m_other),
                            static_cast<QWidget*>(m_mode), static_cast<QWidget*>(m_blend),
                            static_cast<QWidget*>(m_rate), static_cast<QWidget*>(m_visible),
                            static_cast<QWidget*>(m_stretch), static_cast<QWidget*>(m_match),
                            static_cast<QWidget*>(m_swap), static_cast<QWidget*>(m_numbers)})
        row->addWidget(widget);

    connect(m_other, &QComboBox::activated, this, [this](int index) {
        const int cell = m_other->itemData(index).toInt();
        if (cell == kChooseFile) {
            chooseFile();
        } else if (cell != kThisFile) {
            m_comparison.setFile({});
            m_wall.compareWith(cell >= 0 ? std::optional(static_cast<std::size_t>(cell))
                                         : std::nullopt);
        }
    });
    connect(m_mode, &QComboBox::activated, this, [this](int index) {
        m_comparison.setMode(static_cast<CompareMode>(m_mode->itemData(index).toInt()));
    });
    for (const auto signal : {&NumberField::dragged, &NumberField::stepped, &NumberField::edited}) {
        connect(m_blend, signal, this, [this](double percent) {
            m_comparison.setBlend(static_cast<float>(percent / 100.0));
        });
        connect(m_rate, signal, this, [this](double hz) { m_comparison.setFlickerHz(hz); });
    }
    connect(m_visible, &QCheckBox::toggled, &comparison, &WallComparison::setOnlyVisible);
    for (QCheckBox* box : {m_stretch, m_match})
        connect(box, &QCheckBox::toggled, this, [this] {
            m_comparison.setFileSettings({m_stretch->isChecked(), m_match->isChecked()});
        });
    connect(m_swap, &QToolButton::clicked, &wall, &WallState::swapCompared);
    connect(&wall, &WallState::changed, this, &CompareControls::refresh);
    connect(&wall, &WallState::cellsChosen, this, &CompareControls::refresh);
    connect(&comparison, &WallComparison::changed, this, &CompareControls::refresh);
    connect(&comparison, &WallComparison::measuredChanged, this, &CompareControls::showNumbers);
    refresh();
}

void CompareControls::refresh() {
    const bool enlarged = m_wall.enlarged().has_value();
    setVisible(enlarged);
    if (!enlarged)
        return;
    const QSignalBlocker quietMode(m_mode), quietVisible(m_visible), quietStretch(m_stretch),
        quietMatch(m_match);
    fillOthers();
    const bool compared = m_comparison.isOn(), file = m_comparison.hasFile();
    m_mode->setCurrentIndex(m_mode->findData(static_cast<int>(m_comparison.mode())));
    m_mode->setVisible(compared);
    m_swap->setVisible(compared && !file);
    m_numbers->setVisible(compared);
    m_stretch->setVisible(file && m_comparison.needsStretch());
    m_stretch->setChecked(m_comparison.fileSettings().stretch);
    m_match->setVisible(file);
    m_match->setChecked(m_comparison.fileSettings().matchExposure);
    m_blend->setVisible(compared && m_comparison.mode() == CompareMode::Blend);
    m_rate->setVisible(compared && m_comparison.mode() == CompareMode::Flicker);
    m_visible->setVisible(m_comparison.showsDifference());
    m_blend->setValue(std::round(100.0 * static_cast<double>(m_comparison.blend())));
    m_rate->setValue(m_comparison.flickerHz());
    m_visible->setChecked(m_comparison.onlyVisible());
    showNumbers();
}

// Nothing, the other cells, the file that is compared, and the way to another one.
void CompareControls::fillOthers() {
    QList<std::pair<QString, int>> entries{{tr("Nothing"), kNothing}};
    for (std::size_t i = 0; i < m_wall.cells().size(); ++i)
        if (i != *m_wall.enlarged())
            entries.append({captionOf(m_wall.cells()[i]), static_cast<int>(i)});
    if (m_comparison.hasFile())
        entries.append({m_comparison.fileName(), kThisFile});
    entries.append({tr("File…"), kChooseFile});
    const QSignalBlocker quiet(m_other);
    bool same = entries.size() == m_other->count();
    for (int i = 0; same && i < m_other->count(); ++i)
        same = m_other->itemText(i) == entries[i].first &&
               m_other->itemData(i).toInt() == entries[i].second;
    if (!same) {
        m_other->clear();
        for (const auto& [text, data] : entries)
            m_other->addItem(text, data);
    }
    const auto compared = m_wall.compared();
    const int shown = m_comparison.hasFile() ? kThisFile
                      : compared             ? static_cast<int>(*compared)
                                             : kNothing;
    m_other->setCurrentIndex(m_other->findData(shown));
}

void CompareControls::chooseFile() {
    refresh(); // what is compared until one is chosen
    auto* dialog = new QFileDialog(window(), tr("Compare with a Picture"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFile);
    dialog->setNameFilters(
        {tr("Pictures (*.png *.jpg *.jpeg *.exr *.hdr *.tif *.tiff *.tga)"), tr("All files (*)")});
    connect(dialog, &QFileDialog::fileSelected, &m_comparison, &WallComparison::setFile);
    dialog->open();
}

void CompareControls::showNumbers() {
    m_stretch->setVisible(m_comparison.hasFile() && m_comparison.needsStretch());
    if (m_comparison.hasFile() && m_comparison.filePicture().isNull()) {
        m_numbers->setText(m_comparison.fileNote().isEmpty() ? tr("Comparing…")
                                                             : m_comparison.fileNote());
        return;
    }
    if (!m_comparison.measured()) {
        m_numbers->setText(m_comparison.problem().isEmpty() ? tr("Comparing…")
                                                            : m_comparison.problem());
        return;
    }
    const ImageMetrics& metrics = m_comparison.measured()->metrics;
    const ErrorSummary& flip = m_comparison.measured()->flip;
    const QString psnr =
        std::isfinite(metrics.psnr) ? QString::number(metrics.psnr, 'f', 1) : QStringLiteral("∞");
    m_numbers->setText(numbersText(
        QString::number(metrics.rmse, 'g', 3), psnr, QString::number(metrics.relMse, 'g', 3),
        QString::number(flip.mean, 'f', 3), QString::number(flip.max, 'f', 2),
        QString::number(flip.maxPosition.x), QString::number(flip.maxPosition.y)));
    if (m_comparison.hasFile() && !m_comparison.fileNote().isEmpty())
        m_numbers->setText(m_numbers->text() + QStringLiteral("   ") + m_comparison.fileNote());
}

} // namespace patina::editor
