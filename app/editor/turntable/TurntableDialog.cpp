#include "app/editor/turntable/TurntableDialog.h"

#include "app/editor/Session.h"
#include "app/editor/document/ProposedFolder.h"
#include "app/editor/document/QtText.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "app/editor/widget/ControlHelp.h"
#include "app/editor/widget/OutputFile.h"
#include "core/io/ImageIO.h"
#include "core/io/VideoWriter.h"

#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QSpinBox>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <cmath>

namespace patina::editor {
namespace {

const QString kTurntableFolder = QStringLiteral("folders/turntables");
constexpr int kLeastPictures = 2; // as the command line takes them
constexpr int kLargestTurntable = 16384;
// Where the viewport cannot say: what every driver of OpenGL 4.5 takes.
constexpr int kUsualSamples = 4;
constexpr std::array<int, 2> kVideoFormats{4, 5}; // of the formats

QString sceneName(const Session& session) {
    return QFileInfo(session.controller.displayName()).completeBaseName();
}

// How many of the files that will be written are there.
int existingFiles(const TurntableOrder& order) {
    const std::filesystem::path file = toPath(order.file);
    if (isVideoFile(file))
        return QFileInfo::exists(order.file) ? 1 : 0;
    int count = 0;
    for (int i = 0; i < order.count; ++i)
        count += QFileInfo::exists(fromPath(sequenceFile(file, i))) ? 1 : 0;
    return count;
}

// Why nothing can be written to such a file; empty: it can.
QString turntableProblem(const QString& file, const QString& noVideo) {
    if (file.isEmpty())
        return TurntableDialog::tr("Choose a file.");
    const bool video = isVideoFile(toPath(file));
    if (video && !noVideo.isEmpty())
        return noVideo;
    if (!video && !imageFormatForPath(toPath(file)))
        return TurntableDialog::tr("Pictures are written as .png, .jpg, .tif or .exr, videos as "
                                   ".mp4 or .webm; choose one of these endings.");
    const QFileInfo info(file);
    if (!info.absoluteDir().exists())
        return TurntableDialog::tr("The folder %1 does not exist; choose another one.")
            .arg(info.absolutePath());
    return {};
}

} // namespace

TurntableDialog::TurntableDialog(Session& session, const ViewportWidget& viewport, QWidget* parent)
    : QDialog(parent)
    , m_session(session)
    , m_viewport(viewport)
    , m_output(new OutputFile(
          QStringLiteral("turntable"),
          {{tr("PNG, numbered"), QStringLiteral("png"), QStringLiteral("PNG")},
           {tr("JPEG, numbered"), QStringLiteral("jpg"), QStringLiteral("JPEG")},
           {tr("TIFF, numbered"), QStringLiteral("tif"), QStringLiteral("TIFF")},
           {tr("OpenEXR, numbered (linear)"), QStringLiteral("exr"), QStringLiteral("OpenEXR")},
           {tr("MP4 video (H.264)"), QStringLiteral("mp4"), QStringLiteral("MP4")},
           {tr("WebM video (VP9)"), QStringLiteral("webm"), QStringLiteral("WebM")}},
          QDir(proposedFolder(session.controller, kTurntableFolder))
              .filePath(tr("%1 turntable.png").arg(sceneName(session))),
          *this)) {
    if (const auto program = videoProgram(); !program) {
        m_noVideo = UserNotice::fromError(program.error()).text;
        m_noVideo[0] = m_noVideo[0].toUpper();
    }
    setObjectName(QStringLiteral("turntableDialog"));
    setWindowTitle(tr("Export Turntable"));
    resize(640, 360);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(20, 20, 20, 20);
    layout->setSpacing(tokens::kMargin);
    layout->addWidget(makeSettings());
    m_note = new QLabel;
    m_note->setObjectName(QStringLiteral("turntableNote"));
    m_note->setWordWrap(true);
    m_note->setStyleSheet(QStringLiteral("color: %1").arg(QColor(tokens::kTextDim).name()));
    m_note->setText(m_noVideo);
    layout->addWidget(m_note);
    m_summary = new QLabel;
    m_summary->setObjectName(QStringLiteral("turntableSummary"));
    m_summary->setWordWrap(true);
    layout->addWidget(m_summary);
    layout->addStretch(1);
    m_output->addButtons(*layout, tr("Save"));
    if (!m_noVideo.isEmpty())
        for (const int format : kVideoFormats)
            m_output->disableFormat(format, m_noVideo);
    connect(m_output, &OutputFile::changed, this, &TurntableDialog::refresh);
    connect(m_output, &OutputFile::accepted, this, &TurntableDialog::run);
    showLength();
    followPreset();
}

void TurntableDialog::open(Session& session, const ViewportWidget& viewport, QWidget* parent) {
    auto* dialog = new TurntableDialog(session, viewport, parent);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
}

QWidget* TurntableDialog::makeSettings() {
    auto* widget = new QWidget;
    auto* form = new QFormLayout(widget);
    form->setContentsMargins(0, 0, 0, 0);
    form->setHorizontalSpacing(20);
    form->setVerticalSpacing(tokens::kGap);
    form->setFieldGrowthPolicy(QFormLayout::ExpandingFieldsGrow);

    m_turning = withHelp(new QComboBox, tr("What goes once round, by equal steps"));
    m_turning->setObjectName(QStringLiteral("turntableTurning"));
    m_turning->addItem(tr("Camera, round its target"), static_cast<int>(Turning::Camera));
    m_turning->addItem(tr("Environment, round the scene"), static_cast<int>(Turning::Environment));
    form->addRow(tr("What &turns"), m_turning);

    QWidget* counts = makeCounts();
    auto* pictures = new QLabel(tr("&Pictures"));
    pictures->setBuddy(m_count);
    form->addRow(pictures, counts);
    QWidget* size = makeSize();
    auto* sizeLabel = new QLabel(tr("Si&ze"));
    sizeLabel->setBuddy(m_preset);
    form->addRow(sizeLabel, size);

    m_samples = withHelp(new QComboBox, tr("Samples per pixel: more are smoother at edges"));
    m_samples->setObjectName(QStringLiteral("turntableSamples"));
    const gl::ContextInfo* gl = m_viewport.glInfo();
    for (int samples = 1; samples <= (gl != nullptr ? gl->maxSamples : kUsualSamples); samples *= 2)
        m_samples->addItem(QString::number(samples), samples);
    const int usual = m_samples->findData(TurntableOrder().samples);
    m_samples->setCurrentIndex(usual >= 0 ? usual : m_samples->count() - 1);
    form->addRow(tr("Sa&mples"), m_samples);

    m_output->addFormatRow(
        *form, tr("Numbered pictures, one file each, or one video; OpenEXR keeps linear "
                  "values"));
    m_output->addFileRow(*form);
    connect(m_turning, &QComboBox::currentIndexChanged, this, &TurntableDialog::refresh);
    return widget;
}

QWidget* TurntableDialog::makeCounts() {
    m_count = describe(new QSpinBox, tr("Pictures"), tr("How many pictures make one turn"));
    m_count->setObjectName(QStringLiteral("turntableCount"));
    m_count->setRange(kLeastPictures, kMostSequenceFrames);
    m_count->setValue(TurntableOrder().count);
    m_rate = describe(new QSpinBox, tr("Pictures per second"),
                      tr("How fast a video shows them; the number of pictures stays"));
    m_rate->setObjectName(QStringLiteral("turntableRate"));
    m_rate->setRange(1, kMostVideoRate);
    m_rate->setValue(TurntableOrder().framesPerSecond);
    m_rate->setSuffix(tr(" per second"));
    m_length = describe(new QDoubleSpinBox, tr("Length"),
                        tr("How long one turn takes; sets the number of pictures"));
    m_length->setObjectName(QStringLiteral("turntableLength"));
    m_length->setDecimals(2);
    m_length->setSingleStep(0.5);
    m_length->setRange(0.01, kMostSequenceFrames);
    m_length->setSuffix(tr(" s"));
    m_length->setKeyboardTracking(false);
    auto* widget = new QWidget;
    auto* row = new QHBoxLayout(widget);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(tokens::kGap);
    row->addWidget(m_count, 1);
    row->addWidget(new QLabel(tr("at")));
    row->addWidget(m_rate, 1);
    row->addWidget(new QLabel(tr("=")));
    row->addWidget(m_length, 1);
    for (QSpinBox* box : {m_count, m_rate})
        connect(box, &QSpinBox::valueChanged, this, &TurntableDialog::showLength);
    connect(m_length, &QDoubleSpinBox::valueChanged, this, &TurntableDialog::followLength);
    return widget;
}

QWidget* TurntableDialog::makeSize() {
    m_preset = describe(new QComboBox, tr("Size"), tr("Width and height of each picture"));
    m_preset->setObjectName(QStringLiteral("turntablePreset"));
    const QSize view(std::max(1, qRound(m_viewport.width() * m_viewport.devicePixelRatioF())),
                     std::max(1, qRound(m_viewport.height() * m_viewport.devicePixelRatioF())));
    const auto add = [this](const QString& name, const QSize& size) {
        m_preset->addItem(tr("%1 (%2 × %3)").arg(name).arg(size.width()).arg(size.height()), size);
    };
    add(tr("HD"), {1280, 720});
    add(tr("Full HD"), {1920, 1080});
    add(tr("4K"), {3840, 2160});
    add(tr("Square"), {1080, 1080});
    add(tr("Upright"), {1080, 1920});
    add(tr("Half the viewport"), (view / 2).expandedTo({1, 1}));
    add(tr("As the viewport"), view);
    add(tr("Twice the viewport"), 2 * view);
    m_preset->addItem(tr("Custom"), QSize());
    const auto makeSide = [this](const QString& name, const QString& object) {
        auto* side = describe(new QSpinBox, name, tr("%1 of each picture in pixels").arg(name));
        side->setObjectName(object);
        const gl::ContextInfo* gl = m_viewport.glInfo();
        side->setRange(1, gl != nullptr ? std::min(gl->maxTextureSize, kLargestTurntable)
                                        : kLargestTurntable);
        side->setSuffix(tr(" px"));
        connect(side, &QSpinBox::valueChanged, this, &TurntableDialog::showPreset);
        return side;
    };
    m_width = makeSide(tr("Width"), QStringLiteral("turntableWidth"));
    m_height = makeSide(tr("Height"), QStringLiteral("turntableHeight"));
    auto* widget = new QWidget;
    auto* row = new QHBoxLayout(widget);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(tokens::kGap);
    row->addWidget(m_preset, 2);
    row->addWidget(m_width, 1);
    row->addWidget(new QLabel(QStringLiteral("×")));
    row->addWidget(m_height, 1);
    connect(m_preset, &QComboBox::activated, this, &TurntableDialog::followPreset);
    return widget;
}

void TurntableDialog::followLength() {
    const double pictures = std::round(m_length->value() * m_rate->value());
    m_count->setValue(static_cast<int>(std::clamp(pictures, static_cast<double>(kLeastPictures),
                                                  static_cast<double>(kMostSequenceFrames))));
    showLength(); // so many pictures are a little longer or shorter
}

void TurntableDialog::showLength() {
    {
        const QSignalBlocker shown(m_length);
        m_length->setValue(static_cast<double>(m_count->value()) / m_rate->value());
    }
    refresh();
}

void TurntableDialog::followPreset() {
    const QSize size = m_preset->currentData().toSize();
    if (size.isValid()) {
        const QSignalBlocker width(m_width), height(m_height);
        m_width->setValue(size.width());
        m_height->setValue(size.height());
    }
    refresh();
}

void TurntableDialog::showPreset() {
    const QSize size(m_width->value(), m_height->value());
    int index = m_preset->count() - 1; // Custom
    for (int i = 0; i < m_preset->count(); ++i)
        if (m_preset->itemData(i).toSize() == size)
            index = i;
    m_preset->setCurrentIndex(index);
    refresh();
}

TurntableOrder TurntableDialog::order() const {
    TurntableOrder order;
    order.file = QFileInfo(m_output->path()).absoluteFilePath();
    order.turning = static_cast<Turning>(m_turning->currentData().toInt());
    order.count = m_count->value();
    order.framesPerSecond = m_rate->value();
    order.width = m_width->value();
    order.height = m_height->value();
    order.samples = m_samples->currentData().toInt();
    return order;
}

void TurntableDialog::refresh() {
    if (m_samples == nullptr || m_summary == nullptr)
        return; // it is being made
    const TurntableOrder wanted = order();
    const bool video = isVideoFile(toPath(m_output->path()));
    const QString problem = turntableProblem(m_output->path(), m_noVideo);
    const bool possible = problem.isEmpty();
    const int existing = possible ? existingFiles(wanted) : 0;
    const ViewKind view = sceneCopy(m_session).view.shown.kind;
    QString summary;
    if (!possible) {
        summary = problem;
    } else {
        const std::filesystem::path file = toPath(wanted.file);
        summary = video ? tr("A video of %1 pictures of %2 × %3 pixels, %4 s")
                              .arg(wanted.count)
                              .arg(wanted.width)
                              .arg(wanted.height)
                              .arg(m_length->value(), 0, 'f', 2)
                        : tr("%1 pictures of %2 × %3 pixels: %4 to %5")
                              .arg(wanted.count)
                              .arg(wanted.width)
                              .arg(wanted.height)
                              .arg(fromPath(sequenceFile(file, 0).filename()),
                                   fromPath(sequenceFile(file, wanted.count - 1).filename()));
        if (view != shading::kViewFinal)
            summary += tr("; of the view %1").arg(toQString(viewInfo(view).label));
        if (existing > 0)
            summary += video ? tr("; the existing file will be overwritten")
                       : existing == 1
                           ? tr("; one file that exists will be overwritten")
                           : tr("; %1 files that exist will be overwritten").arg(existing);
    }
    m_summary->setText(summary);
    m_note->setVisible(!m_noVideo.isEmpty() && summary != m_noVideo);
    m_summary->setStyleSheet(existing > 0 || !possible
                                 ? QStringLiteral("color: %1").arg(QColor(tokens::kCopper).name())
                                 : QString());
    m_output->setRunnable(possible, existing > 0 ? tr("Overwrite") : tr("Save"));
}

void TurntableDialog::run() {
    rememberFolder(m_session.controller, kTurntableFolder, m_output->path());
    saveTurntable(order(), m_session);
    accept();
}

} // namespace patina::editor
