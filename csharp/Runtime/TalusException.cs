// SPDX-License-Identifier: MIT

using System;
using System.Runtime.InteropServices;
using System.Text;
using Talus.Interop;

namespace Talus
{
    /// <summary>A failure of the library: what was wrong, where, and what to do about it.</summary>
    public sealed class TalusException : Exception
    {
        /// <summary>The name of the failure, to switch on.</summary>
        public tl_result Result { get; private set; }
        /// <summary>The stage of a bake that failed, or null.</summary>
        public string Stage { get; private set; }
        /// <summary>The setting or argument that is wrong, or null.</summary>
        public string Field { get; private set; }
        /// <summary>The kind of element that is wrong, such as "vertex", or null.</summary>
        public string Element { get; private set; }
        /// <summary>Its index in the caller's data, or null.</summary>
        public ulong? ElementIndex { get; private set; }
        /// <summary>What to do about it, or null.</summary>
        public string Advice { get; private set; }

        private TalusException(string message) : base(message)
        {
        }

        /// <summary>The exception for a result of the C interface and its report, which may be null.</summary>
        public static unsafe TalusException Of(tl_result result, tl_report* report)
        {
            tl_report said = report != null ? *report : new tl_report { element_index = Api.TL_NO_ELEMENT };
            string stage = Text(said.stage), field = Text(said.field), element = Text(said.element), advice = Text(said.advice);
            ulong? index = element != null && said.element_index != Api.TL_NO_ELEMENT ? said.element_index : (ulong?)null;
            var words = new StringBuilder();
            words.Append(stage != null ? stage + ": " : "");
            words.Append(field != null ? field + ": " : element != null ? element + (index != null ? " " + index : "") + ": " : "");
            words.Append(Text(Api.tl_result_text(result)));
            words.Append(advice != null ? "; " + advice : "");
            return new TalusException(words.ToString())
            {
                Result = result, Stage = stage, Field = field, Element = element, ElementIndex = index, Advice = advice,
            };
        }

        internal static unsafe void Check(tl_result result, tl_report* report = null)
        {
            if (result != tl_result.TL_OK)
            {
                throw Of(result, report);
            }
        }

        internal static unsafe string Text(byte* text)
        {
            return text != null ? Marshal.PtrToStringAnsi((IntPtr)text) : null;
        }
    }
}
