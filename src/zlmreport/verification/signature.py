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


def signature_finding(state: SignatureState) -> Finding:
    """Return what is to be said of the signatures of a PDF."""
    details = {
        Integrity.INTACT: "; ".join(map(_signed, state.signatures)),
        Integrity.ALTERED: f"the file is signed, but {state.reason}",
        Integrity.UNSIGNED: "not signed: nothing tells who made the file",
        Integrity.UNCHECKED: f"signed, but the signature is not checked: {state.reason}",
    }
    return Finding(_SUBJECT, _VERDICTS[state.integrity], details[state.integrity])


def _signed(signature: Signature) -> str:
    when = f", {signature.stated_time:%Y-%m-%d %H:%M %Z}".rstrip() if signature.stated_time else ""
    whose = f"{signature.signer} (SHA-256 of the signer's certificate {signature.fingerprint})"
    return f"intact, by {whose}{when}"
