// SPDX-License-Identifier: MIT
// Helpers shared by all calls of the C API.
using System;
using System.Text;

namespace Tspace
{
    internal static unsafe partial class Native
    {
        internal partial struct Span
        {
            internal Span(float* data, int count, int strideBytes)
            {
                Data = data;
                Count = (UIntPtr)(uint)count;
                StrideBytes = (UIntPtr)(uint)strideBytes;
            }
        }

        internal static void Check(uint code, ref Error error)
        {
            if (code == 0) return;
            fixed (byte* message = error.Message)
            {
                int length = 0;
                while (length < 240 && message[length] != 0) ++length;
                throw new TspaceException(Encoding.UTF8.GetString(message, length), (ErrorCode)code,
                                          error.Element == ulong.MaxValue ? (long?)null : (long)error.Element);
            }
        }
    }
}
