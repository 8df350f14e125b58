"""Who signed a certificate, and whether the signature holds."""

from __future__ import annotations

from zlmreport.signing.state import Integrity, Signature, SignatureState
from zlmreport.verification.findings import Finding, Verdict

_SUBJECT = "signature"
_VERDICTS = {
    Integrity.INTACT: Verdict.HOLDS,
    Integrity.ALTERED: Verdict.DIFFERS,
    Integrity.UNSIGNED: Verdict.OPEN,
    Integrity.UNCHECKED: Verdict.OPEN,
}


def signature_finding(state: SignatureState, *, is_required: bool) -> Finding:
    """Return what is to be said of the signatures of a PDF.

    `is_required` says whether it must bear an intact signature that is trusted.
    """
    details = {
        Integrity.INTACT: "; ".join(map(_signed, state.signatures)),
        Integrity.ALTERED: f"the file is signed, but {state.reason}",
        Integrity.UNSIGNED: "not signed: nothing tells who made the file",
        Integrity.UNCHECKED: f"signed, but the signature is not checked: {state.reason}",
    }
    verdict, detail = _VERDICTS[state.integrity], details[state.integrity]
    if is_required and not state.is_trusted and state.integrity is not Integrity.UNCHECKED:
        return Finding(_SUBJECT, Verdict.DIFFERS, f"{detail}; a signature that is trusted is required")
    return Finding(_SUBJECT, verdict, detail)


def _signed(signature: Signature) -> str:
    when = f", {signature.stated_time:%Y-%m-%d %H:%M %Z}".rstrip() if signature.stated_time else ""
    whose = f"{signature.signer} (SHA-256 of the signer's certificate {signature.fingerprint})"
    return f"intact, by {whose}{when}, {'trusted' if signature.is_trusted else 'of unknown trust'}"
