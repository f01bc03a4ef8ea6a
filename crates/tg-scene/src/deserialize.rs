//! serde over the tree. Every error gets the span of the innermost value, key or table that it is about.

use std::cell::Cell;

use serde::Deserialize;
use serde::de::value::{StrDeserializer, StringDeserializer};
use serde::de::{
    DeserializeSeed, Deserializer, EnumAccess, IntoDeserializer, MapAccess, SeqAccess, Unexpected,
    VariantAccess, Visitor,
};
use serde::forward_to_deserialize_any;

use crate::error::{ReadError, found};
use crate::node::{Entry, Node, Span, Value};
use crate::spanned;

/// Reads a value of type `T` from the tree.
pub(crate) fn from_node<'de, T: Deserialize<'de>>(node: &'de Node) -> Result<T, ReadError> {
    T::deserialize(node)
}

impl<'de> Deserializer<'de> for &'de Node {
    type Error = ReadError;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, ReadError> {
        let result = match &self.value {
            Value::Null => visitor.visit_unit(),
            Value::Bool(value) => visitor.visit_bool(*value),
            Value::Integer(value) => visitor.visit_i64(*value),
            Value::Float(value) => visitor.visit_f64(*value),
            Value::Text(text) => visitor.visit_borrowed_str(text),
            Value::List(list) => visitor.visit_seq(Items { rest: list.iter() }),
            Value::Table(entries) => {
                let current = Cell::new(None);
                let entries = Entries { rest: entries.iter(), current: &current };
                // A key whose value was not asked for is what the visitor did not like.
                visitor
                    .visit_map(entries)
                    .map_err(|error| error.at_opt(current.get().map(|entry| entry.span.clone())))
            }
        };
        result.map_err(|error| error.at(&self.span))
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, ReadError> {
        match self.value {
            Value::Null => visitor.visit_none(),
            _ => visitor.visit_some(self),
        }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        visitor.visit_newtype_struct(self).map_err(|error| error.at(&self.span))
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        _fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        if name == spanned::NAME {
            return visitor.visit_seq(spanned::Access::new(&self.span, self));
        }
        let unexpected = match &self.value {
            Value::Table(_) => return self.deserialize_any(visitor),
            Value::Null => Unexpected::Unit,
            Value::Bool(value) => Unexpected::Bool(*value),
            Value::Integer(value) => Unexpected::Signed(*value),
            Value::Float(value) => Unexpected::Float(*value),
            Value::Text(text) => Unexpected::Str(text),
            // serde would take a list as the values of a table in order.
            Value::List(_) => Unexpected::Seq,
        };
        let message = format!("expected a table, found {}", found(&unexpected));
        Err(ReadError::new(message).at(&self.span))
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        let result = match &self.value {
            Value::Text(text) => visitor.visit_enum(Variant { name: text, span: &self.span, content: None }),
            Value::Table(entries) => match entries.as_slice() {
                [only] => visitor.visit_enum(Variant {
                    name: &only.key,
                    span: &only.span,
                    content: Some(&only.node),
                }),
                _ => Err(ReadError::new(format!("expected one of {}, and just one", list(variants)))),
            },
            _ => Err(ReadError::new(format!("expected one of {}", list(variants)))),
        };
        result.map_err(|error| error.at(&self.span))
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct seq tuple
        tuple_struct map identifier ignored_any
    }
}

/// Words in quotes, with commas.
pub(crate) fn list(words: &[&str]) -> String {
    words.iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(", ")
}

struct Items<'de> {
    rest: std::slice::Iter<'de, Node>,
}

impl<'de> SeqAccess<'de> for Items<'de> {
    type Error = ReadError;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, ReadError> {
        self.rest.next().map(|node| seed.deserialize(node)).transpose()
    }
}

struct Entries<'de, 'c> {
    rest: std::slice::Iter<'de, Entry>,
    /// The entry whose key has been given and whose value has not.
    current: &'c Cell<Option<&'de Entry>>,
}

impl<'de> MapAccess<'de> for Entries<'de, '_> {
    type Error = ReadError;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, ReadError> {
        self.current.set(self.rest.next());
        let Some(entry) = self.current.get() else { return Ok(None) };
        seed.deserialize(Key(entry)).map(Some).map_err(|error| error.at(&entry.span))
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, ReadError> {
        match self.current.take() {
            Some(entry) => seed.deserialize(&entry.node),
            None => Err(ReadError::new("a value without a key")),
        }
    }
}

/// A key, which may want to know where it stands.
struct Key<'de>(&'de Entry);

impl<'de> Deserializer<'de> for Key<'de> {
    type Error = ReadError;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, ReadError> {
        visitor.visit_borrowed_str(&self.0.key)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        _fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        if name == spanned::NAME {
            let key: StringDeserializer<ReadError> = self.0.key.clone().into_deserializer();
            return visitor.visit_seq(spanned::Access::new(&self.0.span, key));
        }
        self.deserialize_any(visitor)
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map enum identifier ignored_any
    }
}

struct Variant<'de> {
    name: &'de str,
    span: &'de Span,
    content: Option<&'de Node>,
}

impl<'de> EnumAccess<'de> for Variant<'de> {
    type Error = ReadError;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self), ReadError> {
        let name: StrDeserializer<'_, ReadError> = self.name.into_deserializer();
        let value = seed.deserialize(name).map_err(|error| error.at(self.span))?;
        Ok((value, self))
    }
}

impl<'de> Variant<'de> {
    fn content(self) -> Result<&'de Node, ReadError> {
        self.content.ok_or_else(|| {
            ReadError::new(format!("`{}` needs a value", self.name))
                .at(self.span)
                .help(format!("write {{ {} = ... }}", self.name))
        })
    }
}

impl<'de> VariantAccess<'de> for Variant<'de> {
    type Error = ReadError;

    fn unit_variant(self) -> Result<(), ReadError> {
        match self.content {
            None => Ok(()),
            Some(node) => {
                Err(ReadError::new(format!("`{}` stands alone, as text", self.name)).at(&node.span))
            }
        }
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, ReadError> {
        seed.deserialize(self.content()?)
    }

    fn tuple_variant<V: Visitor<'de>>(self, _len: usize, visitor: V) -> Result<V::Value, ReadError> {
        self.content()?.deserialize_any(visitor)
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        _fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        self.content()?.deserialize_any(visitor)
    }
}
