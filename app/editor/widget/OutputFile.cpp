#include "app/editor/widget/OutputFile.h"

#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ControlHelp.h"

#include <QComboBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QStandardItemModel>
#include <QToolButton>

namespace patina::editor {

OutputFile::OutputFile(const QString& name, const std::vector<Format>& formats,
                       const QString& suggestion, QDialog& dialog)
    : QObject(&dialog)
    , m_dialog(dialog)
    , m_name(name)
    , m_formats(formats)
    , m_format(new QComboBox)
    , m_path(new QLineEdit(suggestion)) {
    m_format->setObjectName(name + QStringLiteral("Format"));
    for (const Format& format : formats)
        m_format->addItem(format.title);
    m_path->setObjectName(name + QStringLiteral("Path"));
    connect(m_format, &QComboBox::currentIndexChanged, this, &OutputFile::followFormat);
    connect(m_path, &QLineEdit::textChanged, this, &OutputFile::followPath);
}

void OutputFile::addFormatRow(QFormLayout& form, const QString& help) {
    form.addRow(tr("&Format"), withHelp(m_format, help));
}

void OutputFile::addFileRow(QFormLayout& form) {
    auto* choose = withHelp(new QToolButton, tr("Choose the file"));
    choose->setText(tr("Browse…"));
    choose->setObjectName(QStringLiteral("raised"));
    choose->setAccessibleName(tr("Browse for the file to write"));
    auto* row = new QHBoxLayout;
    row->setSpacing(tokens::kGap);
    row->addWidget(withHelp(m_path, tr("Where to write it")), 1);
    row->addWidget(choose);
    auto* label = new QLabel(tr("Fi&le"));
    label->setBuddy(m_path);
    form.addRow(label, row);
    connect(choose, &QToolButton::clicked, this, &OutputFile::browse);
}

void OutputFile::disableFormat(int index, const QString& reason) {
    // The model that a combo box makes for itself.
    auto* item = qobject_cast<QStandardItemModel*>(m_format->model())->item(index);
    item->setEnabled(false);
    item->setToolTip(reason);
}

void OutputFile::addButtons(QLayout& layout, const QString& run) {
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
    m_run = buttons->addButton(run, QDialogButtonBox::AcceptRole);
    m_run->setObjectName(m_name + QStringLiteral("Run"));
    m_run->setProperty("primary", true);
    m_run->setDefault(true);
    layout.addWidget(buttons);
    connect(buttons, &QDialogButtonBox::rejected, &m_dialog, &QDialog::reject);
    connect(buttons, &QDialogButtonBox::accepted, this, &OutputFile::accepted);
}

int OutputFile::format() const {
    return m_format->currentIndex();
}

QString OutputFile::path() const {
    return m_path->text().trimmed();
}

void OutputFile::setRunnable(bool runnable, const QString& run) {
    m_run->setEnabled(runnable);
    m_run->setText(run);
}

void OutputFile::browse() {
    QStringList filters;
    for (const Format& format : m_formats)
        filters << QStringLiteral("%1 (*.%2)").arg(format.filter, format.extension);
    const QString file = QFileDialog::getSaveFileName(
        &m_dialog, m_dialog.windowTitle(), m_path->text(), filters.join(QStringLiteral(";;")),
        nullptr, QFileDialog::DontConfirmOverwrite); // the dialog says what is overwritten
    if (!file.isEmpty())
        m_path->setText(file);
}

void OutputFile::followFormat() {
    const QFileInfo info(m_path->text());
    const QString extension = m_formats[static_cast<std::size_t>(format())].extension;
    const QString renamed =
        info.dir().filePath(info.completeBaseName() + QLatin1Char('.') + extension);
    if (renamed != m_path->text())
        m_path->setText(renamed); // tells of the change
    else
        Q_EMIT changed();
}

void OutputFile::followPath() {
    const QString extension = QFileInfo(path()).suffix();
    for (std::size_t i = 0; i < m_formats.size(); ++i)
        if (extension.compare(m_formats[i].extension, Qt::CaseInsensitive) == 0) {
            const QSignalBlocker typing(m_format); // what is typed is left alone
            m_format->setCurrentIndex(static_cast<int>(i));
        }
    Q_EMIT changed();
}

} // namespace patina::editor
