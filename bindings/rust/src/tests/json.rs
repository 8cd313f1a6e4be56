// SPDX-License-Identifier: MIT
//! A reader for the table of cases. It accepts valid JSON without escapes in texts.

pub enum Json {
    Null,
    Bool(bool),
    Number(f64),
    Text(String),
    List(Vec<Json>),
    Object(Vec<(String, Json)>),
}

impl Json {
    pub fn parse(text: &str) -> Json {
        value(&mut text.trim())
    }
    /// The member of this name, or null.
    pub fn get(&self, name: &str) -> &Json {
        self.members().iter().find(|(member, _)| member == name).map_or(&Json::Null, |(_, value)| value)
    }
    pub fn members(&self) -> &[(String, Json)] {
        if let Json::Object(members) = self { members } else { &[] }
    }
    pub fn list(&self) -> &[Json] {
        if let Json::List(list) = self { list } else { &[] }
    }
    pub fn text(&self) -> &str {
        if let Json::Text(text) = self { text } else { "" }
    }
    pub fn number_or(&self, other: f64) -> f64 {
        if let Json::Number(number) = self { *number } else { other }
    }
    pub fn number(&self) -> f64 {
        self.number_or(f64::NAN)
    }
    pub fn is_true(&self) -> bool {
        matches!(self, Json::Bool(true))
    }
    pub fn floats(&self) -> Vec<f32> {
        self.list().iter().map(|entry| entry.number() as f32).collect()
    }
    pub fn integers(&self) -> Vec<u32> {
        self.list().iter().map(|entry| entry.number() as u32).collect()
    }
}

/// Removes a prefix, and spaces around it.
fn skip(text: &mut &str, prefix: &str) -> bool {
    let found = text.trim_start().strip_prefix(prefix);
    *text = found.unwrap_or(text).trim_start();
    found.is_some()
}

fn text_of(text: &mut &str) -> String {
    let (found, rest) = text[1..].split_once('"').unwrap();
    *text = rest;
    found.to_string()
}

fn value(text: &mut &str) -> Json {
    for (word, constant) in [("null", Json::Null), ("true", Json::Bool(true)), ("false", Json::Bool(false))] {
        if skip(text, word) {
            return constant;
        }
    }
    if skip(text, "[") {
        let mut list = Vec::new();
        while !skip(text, "]") {
            list.push(value(text));
            skip(text, ",");
        }
        return Json::List(list);
    }
    if skip(text, "{") {
        let mut members = Vec::new();
        while !skip(text, "}") {
            let name = text_of(text);
            skip(text, ":");
            members.push((name, value(text)));
            skip(text, ",");
        }
        return Json::Object(members);
    }
    if text.starts_with('"') {
        return Json::Text(text_of(text));
    }
    let end = text.find(|c: char| !"+-.eE0123456789".contains(c)).unwrap_or(text.len());
    let (number, rest) = text.split_at(end);
    *text = rest;
    Json::Number(number.parse().unwrap())
}
