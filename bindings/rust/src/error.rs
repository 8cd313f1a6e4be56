// SPDX-License-Identifier: MIT
use crate::enums::ErrorCode;
use crate::sys;
use std::ffi::CStr;
use std::fmt;

/// Error of a failed call, with a human-readable message and the location of the fault.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// The kind of error.
    pub code: ErrorCode,
    /// Index of the invalid element, if any.
    pub element: Option<u64>,
    /// Description in one sentence.
    pub message: String,
}

impl fmt::Display for Error {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.message)
    }
}

impl std::error::Error for Error {}

pub(crate) fn mismatch(message: String) -> Error {
    Error { code: ErrorCode::CountMismatch, element: None, message }
}

/// Calls a function of the C API, and converts its error.
pub(crate) fn checked(call: impl FnOnce(*mut sys::Error) -> u32) -> Result<(), Error> {
    let mut error = sys::Error { code: 0, reserved: 0, element: 0, message: [0; 240] };
    let code = call(&mut error);
    if code == sys::OK {
        return Ok(());
    }
    // SAFETY: the library terminates the message with 0.
    let message = unsafe { CStr::from_ptr(error.message.as_ptr()) };
    let message = message.to_string_lossy().into_owned();
    let element = if error.element == sys::NO_ELEMENT { None } else { Some(error.element) };
    Err(Error { code: ErrorCode::of(code), element, message })
}
