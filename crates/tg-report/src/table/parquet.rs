//! Parquet: one required DOUBLE column for each channel, plain and uncompressed; units and groups in the key-value
//! metadata of the file.

use std::fs::File;
use std::panic::catch_unwind;
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{Encoding, Repetition, Type as Physical};
use parquet::column::reader::get_typed_column_reader;
use parquet::data_type::DoubleType;
use parquet::errors::ParquetError;
use parquet::file::metadata::{ColumnChunkMetaData, KeyValue};
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use crate::error::ReportError;
use crate::folder::write_file;
use crate::table::{Channel, Table};

/// Key of the channels, as JSON, in the metadata of a file.
const CHANNELS: &str = "tg.channels";

impl Table {
    /// Writes a Parquet file: `pandas.read_parquet(path)` has a column for each channel. Units and groups are in the
    /// key-value metadata under `tg.channels`, as JSON.
    ///
    /// # Errors
    /// The file cannot be written, or the table is ill-formed.
    pub fn write_parquet(&self, path: &Path) -> Result<(), ReportError> {
        write_file(path, &self.parquet(path)?)
    }

    /// The content of a Parquet file; `path` is for errors.
    pub(crate) fn parquet(&self, path: &Path) -> Result<Vec<u8>, ReportError> {
        self.check()?;
        let channels = serde_json::to_string(&self.channels).map_err(ReportError::json(path))?;
        write(self, channels).map_err(|e| ReportError::damaged(path, e))
    }

    /// Reads a Parquet file of float64 columns.
    ///
    /// # Errors
    /// The file cannot be read, or has columns of another type.
    pub fn read_parquet(path: &Path) -> Result<Self, ReportError> {
        let file = File::open(path).map_err(ReportError::io("read", path))?;
        // The reader of Parquet panics where what a damaged file says about itself contradicts itself.
        let read = catch_unwind(|| read(file));
        let read = read.map_err(|_| ReportError::damaged(path, "it contradicts itself"))?;
        let (table, channels) = read.map_err(|e| ReportError::damaged(path, e))?;
        match channels {
            None => Ok(table),
            Some(json) => {
                let channels: Vec<Channel> = serde_json::from_str(&json).map_err(ReportError::json(path))?;
                let table = Self { channels, ..table };
                table.check().map(|()| table)
            }
        }
    }
}

fn write(table: &Table, channels: String) -> Result<Vec<u8>, ParquetError> {
    let column = |c: &Channel| {
        let kind = Type::primitive_type_builder(&c.name, Physical::DOUBLE);
        kind.with_repetition(Repetition::REQUIRED).build().map(Arc::new)
    };
    let columns = table.channels.iter().map(column).collect::<Result<Vec<_>, _>>()?;
    let schema = Type::group_type_builder("trajectory").with_fields(columns).build()?;
    // Numbers of a motion repeat seldom: a dictionary would only cost time.
    let properties = WriterProperties::builder()
        .set_dictionary_enabled(false)
        .set_encoding(Encoding::PLAIN)
        .set_statistics_enabled(EnabledStatistics::None)
        .set_created_by(concat!("tg-report version ", env!("CARGO_PKG_VERSION")).into())
        .set_key_value_metadata(Some(vec![KeyValue::new(CHANNELS.into(), channels)]))
        .build();
    let mut writer = SerializedFileWriter::new(Vec::new(), Arc::new(schema), Arc::new(properties))?;
    let mut group = writer.next_row_group()?;
    let mut columns = table.columns.iter();
    while let Some(mut writer) = group.next_column()? {
        let values = columns.next().map_or(&[][..], Vec::as_slice);
        writer.typed::<DoubleType>().write_batch(values, None, None)?;
        writer.close()?;
    }
    group.close()?;
    writer.into_inner()
}

fn read(file: File) -> Result<(Table, Option<String>), ParquetError> {
    let bytes = file.metadata()?.len();
    let reader = SerializedFileReader::new(file)?;
    let metadata = reader.metadata().file_metadata();
    let columns = metadata.schema_descr().columns();
    if let Some(other) =
        columns.iter().find(|c| c.physical_type() != Physical::DOUBLE || c.max_def_level() > 0)
    {
        return Err(ParquetError::General(format!("column {:?} is not a required float64", other.name())));
    }
    let mut table = Table::new(columns.iter().map(|c| Channel::new(c.name(), "", "")).collect());
    let pairs = metadata.key_value_metadata();
    let channels = pairs.and_then(|pairs| pairs.iter().find(|p| p.key == CHANNELS)?.value.clone());
    for k in 0..reader.num_row_groups() {
        let group = reader.get_row_group(k)?;
        let outside = |column: &ColumnChunkMetaData| {
            let start = column.dictionary_page_offset().unwrap_or(column.data_page_offset());
            let [start, size] = [start, column.compressed_size()].map(u64::try_from);
            !matches!((start, size), (Ok(start), Ok(size)) if start.saturating_add(size) <= bytes)
        };
        if let Some(column) = group.metadata().columns().iter().find(|column| outside(column)) {
            return Err(ParquetError::EOF(format!("column {} is not in the file", column.column_path())));
        }
        let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
        for (i, column) in table.columns.iter_mut().enumerate() {
            let expected = column.len() + rows;
            let mut reader = get_typed_column_reader::<DoubleType>(group.get_column_reader(i)?);
            while column.len() < expected {
                if reader.read_records(expected - column.len(), None, None, column)?.0 == 0 {
                    return Err(ParquetError::EOF(format!("column {i} ends early")));
                }
            }
        }
    }
    Ok((table, channels))
}
